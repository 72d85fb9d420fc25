#include "reduce/matrices/matrix_set.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/direction_words.hpp"
#include "reduce/matrices/set_algebra.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

}  // namespace

Eigen::VectorXd largest_entries(const SparseColumns& matrix) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(matrix.cols());
  for (Eigen::Index j = 0; j < matrix.outerSize(); ++j)
    for (SparseColumns::InnerIterator entry(matrix, j); entry; ++entry) {
      result(j) = std::max(result(j), std::abs(entry.value()));
      result(entry.row()) = std::max(result(entry.row()), std::abs(entry.value()));
    }
  return result;
}

Eigen::Index MatrixSet::scalars() const {
  return std::count_if(unknowns.begin(), unknowns.end(), [](const NodalUnknown& u) { return u.is_scalar(); });
}

std::string MatrixSet::name_of(Eigen::Index unknown) const {
  const NodalUnknown& u = unknowns[static_cast<std::size_t>(unknown)];
  if (u.is_scalar()) return fmt::format("scalar {}", u.component + 1);
  return fmt::format("node {} {}", numbers[static_cast<std::size_t>(u.node)],
                     direction_words[static_cast<std::size_t>(u.component)]);
}

Eigen::Index remove_empty_unknowns(MatrixSet& set) {
  const Eigen::VectorXd largest = largest_entries(set.stiffness).cwiseMax(largest_entries(set.mass));
  Unknowns kept;
  std::vector<NodalUnknown> unknowns;
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    if (largest(k) == 0) continue;
    kept.push_back(k);
    unknowns.push_back(set.unknowns[static_cast<std::size_t>(k)]);
  }
  const Eigen::Index removed = set.size() - static_cast<Eigen::Index>(kept.size());
  if (removed == 0) return 0;
  for (SparseColumns* matrix : {&set.stiffness, &set.mass, &set.damping, &set.geometric_stiffness})
    if (matrix->size() > 0) *matrix = submatrix(*matrix, kept, kept);
  for (Eigen::MatrixXd& matrix : set.inertia_components)
    if (matrix.size() > 0) matrix = Eigen::MatrixXd(matrix(kept, kept));
  for (auto& [name, quantity] : set.quantities) quantity.matrix = Eigen::MatrixXd(quantity.matrix(Eigen::all, kept));
  if (set.shapes) {
    if (set.shapes->stress.size() > 0) set.shapes->stress = Eigen::MatrixXd(set.shapes->stress(Eigen::all, kept));
    set.shapes->displacement = Eigen::MatrixXd(set.shapes->displacement(Eigen::all, kept));
    if (set.shapes->rotation.size() > 0) set.shapes->rotation = Eigen::MatrixXd(set.shapes->rotation(Eigen::all, kept));
  }
  set.unknowns = std::move(unknowns);
  return removed;
}

double reference_eigenvalue(const MatrixSet& set) {
  const Eigen::VectorXd k = set.stiffness.diagonal(), m = set.mass.diagonal();
  std::vector<double> scalars, all;
  for (Eigen::Index i = 0; i < set.size(); ++i) {
    if (!(k(i) > 0) || !(m(i) > 0)) continue;
    all.push_back(k(i) / m(i));
    if (set.unknowns[static_cast<std::size_t>(i)].is_scalar()) scalars.push_back(all.back());
  }
  if (!scalars.empty()) return *std::min_element(scalars.begin(), scalars.end());
  if (all.empty()) return 0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

void clear_rounding(MatrixSet& set) {
  const double least = (set.scalars() > 0 ? 1e-8 : 1e-14) * reference_eigenvalue(set);
  const Eigen::VectorXd m = set.mass.diagonal().cwiseMax(0);
  std::vector<bool> is_rounding(set.unknowns.size(), true);
  for (std::size_t i = 0; i < is_rounding.size(); ++i) is_rounding[i] = m(static_cast<Eigen::Index>(i)) > 0;
  for (Eigen::Index j = 0; j < set.stiffness.outerSize(); ++j)
    for (SparseColumns::InnerIterator entry(set.stiffness, j); entry; ++entry)
      if (std::abs(entry.value()) > least * std::sqrt(m(entry.row()) * m(j)))
        is_rounding[static_cast<std::size_t>(entry.row())] = is_rounding[static_cast<std::size_t>(j)] = false;
  set.stiffness.prune([&](Eigen::Index row, Eigen::Index column, double) {
    return !is_rounding[static_cast<std::size_t>(row)] && !is_rounding[static_cast<std::size_t>(column)];
  });
}

SparseColumns nodal_motions(const MatrixSet& set, bool rotations) {
  Triplets entries;
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
    if (u.is_scalar() || u.is_rotation() != rotations) continue;
    const Eigen::Vector3d direction = set.axes[static_cast<std::size_t>(u.node)].col(u.component % 3);
    for (int i = 0; i < 3; ++i)
      if (direction(i) != 0) entries.emplace_back(3 * u.node + i, static_cast<int>(k), direction(i));
  }
  SparseColumns result(3 * set.positions.cols(), set.size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Eigen::MatrixXd nodal_rigid_motions(const MatrixSet& set, const Eigen::Vector3d& about) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(set.size(), 6);
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
    if (u.is_scalar()) continue;
    Interface node;
    node.position = set.positions.col(u.node);
    node.rotation = set.axes[static_cast<std::size_t>(u.node)];
    result.row(k) = interface_rigid_motion(node, u.component, about);
  }
  return result;
}

}  // namespace bielle::reduce
