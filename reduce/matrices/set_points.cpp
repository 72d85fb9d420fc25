#include "reduce/matrices/set_points.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/reduction/residual_combination.hpp"
#include "reduce/superelement/point_weights.hpp"

namespace bielle::reduce {

namespace {

/// Returns whether a node has unknowns for all three displacements, or rotations.
bool has_all(const MatrixSet& set, int node, bool rotations) {
  return std::count_if(set.unknowns.begin(), set.unknowns.end(),
                       [&](const NodalUnknown& u) { return u.node == node && u.is_rotation() == rotations; }) == 3;
}

/// Returns the displacement or rotation of a node (3,n).
Eigen::MatrixXd rows_of_node(const MatrixSet& set, int node, bool rotations) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, set.size());
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
    if (u.node == node && u.is_rotation() == rotations)
      result.col(k) = set.axes[static_cast<std::size_t>(node)].col(u.component % 3);
  }
  return result;
}

/// Returns the cells whose nodes are all points. @param point_of  point of each node, or -1
std::map<int, Eigen::MatrixXi> cells_of(const std::map<int, Eigen::MatrixXi>& cells, const std::vector<int>& point_of) {
  std::map<int, Eigen::MatrixXi> result;
  for (const auto& [type, block] : cells) {
    const Eigen::MatrixXi points = block.unaryExpr([&](int node) { return point_of[static_cast<std::size_t>(node)]; });
    std::vector<Eigen::Index> whole;
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      if (points.col(k).minCoeff() >= 0) whole.push_back(k);
    if (!whole.empty()) result[type] = points(Eigen::all, whole);
  }
  return result;
}

/// Returns unit forces and moments (n, k) of the requested directions.
Eigen::MatrixXd loads_of(const SetPoint& point) {
  std::vector<int> wanted;
  for (int axis = 0; axis < 6; ++axis)
    if (point.request.residual[static_cast<std::size_t>(axis)]) wanted.push_back(axis);
  return point.rows(wanted, Eigen::all).transpose();
}

}  // namespace

PointMotions point_motions(const MatrixSet& set) {
  PointMotions result;
  if (set.shapes) {
    result.points = set.shapes->points;
    result.cells = set.shapes->cells;
    result.displacement = set.shapes->displacement.sparseView();
    return result;
  }
  std::vector<int> translations(set.numbers.size(), 0), point_of(set.numbers.size(), -1), nodes;
  for (const NodalUnknown& u : set.unknowns)
    if (!u.is_scalar() && !u.is_rotation()) ++translations[static_cast<std::size_t>(u.node)];
  for (std::size_t a = 0; a < translations.size(); ++a)
    if (translations[a] == 3) {
      point_of[a] = static_cast<int>(nodes.size());
      nodes.push_back(static_cast<int>(a));
    }
  result.points = set.positions(Eigen::all, nodes);
  const SparseColumns all = nodal_motions(set, false);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index k = 0; k < all.outerSize(); ++k)
    for (SparseColumns::InnerIterator entry(all, k); entry; ++entry)
      if (const int point = point_of[static_cast<std::size_t>(entry.row() / 3)]; point >= 0)
        entries.emplace_back(3 * point + static_cast<int>(entry.row() % 3), static_cast<int>(k), entry.value());
  result.cells = cells_of(set.cells, point_of);
  result.displacement.resize(3 * result.points.cols(), set.size());
  result.displacement.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::vector<SetPoint> set_points(const MatrixSet& set, const PointMotions& motions,
                                 const std::vector<NodePoint>& requests) {
  std::vector<SetPoint> result;
  std::set<std::string> names;
  for (const NodePoint& request : requests)
    about(request.subject, [&] {
      if (!names.insert(request.name).second) throw InputError(fmt::format("there are two points '{}'", request.name));
      const int node = request.node ? node_index(set, *request.node) : -1;
      SetPoint point{request, node >= 0 ? Eigen::Vector3d(set.positions.col(node)) : *request.place, {}};
      const PointWeights around = point_weights(motions.points, point.position, set.name);
      point.rows.setZero(6, set.size());
      for (std::size_t a = 0; a < around.nodes.size(); ++a)
        for (int i = 0; i < 3; ++i)
          for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(motions.displacement,
                                                                                 3 * around.nodes[a] + i);
               entry; ++entry)
            point.rows.col(entry.col()) += entry.value() * around.rows.col(3 * static_cast<Eigen::Index>(a) + i);
      if (node >= 0 && has_all(set, node, false)) point.rows.topRows(3) = rows_of_node(set, node, false);
      if (node >= 0 && has_all(set, node, true)) point.rows.bottomRows(3) = rows_of_node(set, node, true);
      result.push_back(std::move(point));
    });
  return result;
}

Eigen::Index add_residual_vectors(const MatrixSet& set, const NodeTies& ties, const HeldMatrices& held,
                                  const std::vector<SetPoint>& points, const Eigen::MatrixXd& inertia,
                                  MatrixBasis& basis) {
  Eigen::MatrixXd loads(set.size(), 0);
  std::vector<std::string> subjects;  // one for each load of a point
  for (const SetPoint& point : points) {
    const Eigen::MatrixXd more = loads_of(point);
    loads.conservativeResize(Eigen::NoChange, loads.cols() + more.cols());
    loads.rightCols(more.cols()) = more;
    subjects.insert(subjects.end(), static_cast<std::size_t>(more.cols()), point.request.subject);
  }
  if (inertia.cols() > 0) {
    loads.conservativeResize(Eigen::NoChange, loads.cols() + inertia.cols());
    loads.rightCols(inertia.cols()) = inertia;
  }
  if (loads.cols() == 0) return 0;
  const Eigen::MatrixXd inside = ties.inside.transpose() * loads;
  const RowMatrix answers = ties.inside * held.solve(inside);
  const RowMatrix modes = basis.shapes.rightCols(basis.eigenvalues.size());
  const Eigen::VectorXd least = inside.colwise().squaredNorm().transpose() / set.stiffness.diagonal().maxCoeff();
  const ResidualCombination found = combine_residuals(answers, modes, least,
                                                      {[&](const RowMatrix& u) { return RowMatrix(set.stiffness * u); },
                                                       [&](const RowMatrix& u) { return RowMatrix(set.mass * u); }});
  for (std::size_t k = 0; k < subjects.size();) {
    const std::size_t end = k + static_cast<std::size_t>(std::count(subjects.begin(), subjects.end(), subjects[k]));
    if (std::none_of(found.is_left.begin() + static_cast<std::ptrdiff_t>(k),
                     found.is_left.begin() + static_cast<std::ptrdiff_t>(end), [](bool left) { return left; }))
      throw InputError(subjects[k],
                       "its loads leave nothing for residual vectors: interfaces carry them, or the modes represent "
                       "their response already; remove `residual`");
    k = end;
  }
  const Eigen::Index count = found.eigenvalues.size();
  basis.shapes.conservativeResize(Eigen::NoChange, basis.shapes.cols() + count);
  basis.shapes.rightCols(count) = found.fields;
  basis.eigenvalues.conservativeResize(basis.eigenvalues.size() + count);
  basis.eigenvalues.tail(count) = found.eigenvalues;
  return count;
}

}  // namespace bielle::reduce
