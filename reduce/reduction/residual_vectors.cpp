#include "reduce/reduction/residual_vectors.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/reduction/load_patterns.hpp"
#include "reduce/reduction/residual_combination.hpp"

namespace bielle::reduce {

namespace {

RowMatrix all_loads(const std::vector<ResidualRequest>& requests, Eigen::Index rows) {
  Eigen::Index count = 0;
  for (const ResidualRequest& request : requests) count += request.loads.cols();
  RowMatrix loads(rows, count);
  Eigen::Index column = 0;
  for (const ResidualRequest& request : requests) {
    loads.middleCols(column, request.loads.cols()) = RowMatrix(request.loads);
    column += request.loads.cols();
  }
  return loads;
}

/// Returns the reference energy of an answer, for the case that the conditions leave nothing of it but rounding: the
/// load against the stiffest spring of the mesh.
Eigen::VectorXd least_energies(const BodyMatrices& matrices, const Eigen::MatrixXd& loads) {
  return loads.colwise().squaredNorm().transpose() / matrices.stiffness_diagonal().maxCoeff();
}

void check_requests(const std::vector<ResidualRequest>& requests, const std::vector<bool>& is_left) {
  auto first = is_left.begin();
  for (const ResidualRequest& request : requests) {
    const auto end = first + request.loads.cols();
    if (!request.may_be_empty && std::none_of(first, end, [](bool left) { return left; }))
      throw InputError(request.subject,
                       "its loads leave nothing for residual vectors: interfaces carry them, or the modes represent "
                       "their response already; remove `residual`");
    first = end;
  }
}

void append_to_basis(const ResidualCombination& found, const Eigen::MatrixXd& released_answers, Basis& basis) {
  const Eigen::Index count = found.eigenvalues.size(), before = basis.shapes.cols(), modes = basis.modes();
  const Eigen::MatrixXd released =
      released_answers * found.of_answers - basis.released.rightCols(modes) * found.of_modes;
  basis.shapes.conservativeResize(Eigen::NoChange, before + count);
  basis.shapes.rightCols(count) = found.fields;
  basis.released.conservativeResize(Eigen::NoChange, before + count);
  basis.released.rightCols(count) = released;
  basis.eigenvalues.conservativeResize(modes + count);
  basis.eigenvalues.tail(count) = found.eigenvalues;
  basis.residual_vectors = count;
}

SparseRows loads_of_point(const TiedPoint& point) {
  const auto& wanted = point.request.residual;
  SparseRows loads(point.spread.rows(), std::count(wanted.begin(), wanted.end(), true));
  std::vector<Eigen::Triplet<double>> entries;
  std::array<int, 6> column{};
  for (std::size_t axis = 1; axis < 6; ++axis) column[axis] = column[axis - 1] + (wanted[axis - 1] ? 1 : 0);
  for (Eigen::Index row = 0; row < point.spread.outerSize(); ++row)
    for (SparseRows::InnerIterator entry(point.spread, row); entry; ++entry)
      if (wanted[entry.col()]) entries.emplace_back(static_cast<int>(row), column[entry.col()], entry.value());
  loads.setFromTriplets(entries.begin(), entries.end());
  return loads;
}

/// Returns columns 3 k + l: component k of the pattern acting along axis l. Components that are rounding errors of the
/// others, such as those of a pressure on a plane, stay zero.
SparseRows loads_of_pattern(const Solid& solid, const LoadRequest& request) {
  const PatternForces pattern = pattern_forces(solid.mesh, request);
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < 3; ++k) {
    if (pattern.forces.row(k).norm() <= negligible_energy * pattern.forces.norm()) continue;
    for (std::size_t a = 0; a < pattern.nodes.size(); ++a)
      for (int l = 0; l < 3; ++l)
        entries.emplace_back(3 * pattern.nodes[a] + l, 3 * k + l, pattern.forces(k, static_cast<Eigen::Index>(a)));
  }
  SparseRows loads(3 * solid.points(), 9);
  loads.setFromTriplets(entries.begin(), entries.end());
  return loads;
}

}  // namespace

std::vector<ResidualRequest> residual_requests(const Solid& solid, const std::vector<LoadRequest>& loads,
                                               const std::vector<TiedPoint>& points) {
  std::vector<ResidualRequest> requests;
  for (const TiedPoint& point : points) {
    SparseRows of_point = loads_of_point(point);
    if (of_point.cols() > 0) requests.push_back({point.request.subject, std::move(of_point)});
  }
  for (const LoadRequest& load : loads)
    if (load.residual) requests.push_back({load.subject, loads_of_pattern(solid, load)});
  return requests;
}

void add_residual_vectors(const std::vector<ResidualRequest>& requests, const BodyMatrices& matrices,
                          const FixedInterfaceBody& held, Basis& basis) {
  if (requests.empty()) return;
  const Eigen::MatrixXd loads = held.restrict(all_loads(requests, basis.shapes.rows()));
  const Eigen::MatrixXd answers = held.solve(loads);
  const RowMatrix modes = basis.shapes.rightCols(basis.modes());
  const ResidualCombination found = combine_residuals(held.expand(answers), modes, least_energies(matrices, loads),
                                                      {[&](const RowMatrix& u) { return matrices.stiffness_times(u); },
                                                       [&](const RowMatrix& u) { return matrices.mass_times(u); }});
  check_requests(requests, found.is_left);
  if (found.eigenvalues.size() > 0) append_to_basis(found, answers.bottomRows(basis.released.rows()), basis);
}

}  // namespace bielle::reduce
