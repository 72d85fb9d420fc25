#include "reduce/reduction/residual_vectors.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/leading_component.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/load_patterns.hpp"
#include "reduce/reduction/reduced_matrices.hpp"

namespace bielle::reduce {

namespace {

/// Energies below this share of the whole answer's count as zero, and so do directions in which all vectors together
/// have less. It corresponds to displacements of 1e-5, far above the rounding of solutions and far below the accuracy
/// that a load needs.
constexpr double negligible = 1e-10;

/// Displacement fields of the held body.
struct HeldFields {
  RowMatrix shapes;          ///< (3 points, k)
  Eigen::MatrixXd released;  ///< (released directions, k): their values

  void combine(const Eigen::MatrixXd& weights) {
    shapes = RowMatrix(shapes * weights);
    released = Eigen::MatrixXd(released * weights);
  }
  /// Makes leading components positive, whatever the signs of the eigenvectors.
  void choose_signs() {
    for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
      if (leading_component(shapes.col(k)) >= 0) continue;
      shapes.col(k) = -shapes.col(k);
      released.col(k) = -released.col(k);
    }
  }
};

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

/// r = u - Phi Phi^T M u
void remove_modes(const BodyMatrices& matrices, const Basis& basis, HeldFields& fields) {
  if (basis.modes() == 0) return;
  const RowMatrix modes = basis.shapes.rightCols(basis.modes());
  const Eigen::MatrixXd amplitudes = inner_products(modes, matrices.mass_times(fields.shapes));
  fields.shapes -= modes * amplitudes;
  fields.released -= basis.released.rightCols(basis.modes()) * amplitudes;
}

Eigen::VectorXd twice_energies(const BodyMatrices& matrices, const RowMatrix& fields) {
  return fields.cwiseProduct(matrices.stiffness_times(fields)).colwise().sum().transpose();
}

/// Reference energy of an answer, for the case that the conditions leave nothing of it but rounding: the load against
/// the stiffest spring of the mesh.
Eigen::VectorXd least_energies(const BodyMatrices& matrices, const Eigen::MatrixXd& loads) {
  return loads.colwise().squaredNorm().transpose() / matrices.stiffness_diagonal().maxCoeff();
}

void check_requests(const std::vector<ResidualRequest>& requests, const std::vector<bool>& is_left) {
  auto first = is_left.begin();
  for (const ResidualRequest& request : requests) {
    const auto end = first + request.loads.cols();
    if (!request.may_be_empty && std::none_of(first, end, [](bool left) { return left; }))
      throw InputError(
          request.subject,
          "its loads leave nothing for residual vectors: interfaces carry them, or the modes have their answer "
          "already; remove `residual`");
    first = end;
  }
}

/// Combinations of unit energy that are orthogonal in K; linearly dependent ones are left out.
Eigen::MatrixXd independent_fields(const Eigen::MatrixXd& energies) {
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(energies);
  const Eigen::Index rank = (pairs.values.array() > negligible * pairs.values.maxCoeff()).count();
  const Eigen::VectorXd scale = pairs.values.tail(rank).cwiseSqrt().cwiseInverse();
  return pairs.vectors.rightCols(rank) * scale.asDiagonal();
}

void append_to_basis(const HeldFields& fields, const Eigen::VectorXd& eigenvalues, Basis& basis) {
  const Eigen::Index count = eigenvalues.size(), before = basis.shapes.cols(), modes = basis.modes();
  basis.shapes.conservativeResize(Eigen::NoChange, before + count);
  basis.shapes.rightCols(count) = fields.shapes;
  basis.released.conservativeResize(Eigen::NoChange, before + count);
  basis.released.rightCols(count) = fields.released;
  basis.eigenvalues.conservativeResize(modes + count);
  basis.eigenvalues.tail(count) = eigenvalues;
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

/// Column 3 k + l: component k of the pattern acting along axis l. Components that are rounding errors of the others,
/// such as those of a pressure on a plane, stay zero.
SparseRows loads_of_pattern(const Solid& solid, const LoadRequest& request) {
  const PatternForces pattern = pattern_forces(solid.mesh, request);
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < 3; ++k) {
    if (pattern.forces.row(k).norm() <= negligible * pattern.forces.norm()) continue;
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
  HeldFields fields{held.expand(answers), answers.bottomRows(basis.released.rows())};
  const Eigen::VectorXd whole = twice_energies(matrices, fields.shapes).cwiseMax(least_energies(matrices, loads));
  remove_modes(matrices, basis, fields);
  const Eigen::VectorXd rest = twice_energies(matrices, fields.shapes);
  std::vector<bool> is_left;
  std::vector<Eigen::Index> left;
  for (Eigen::Index k = 0; k < rest.size(); ++k) {
    is_left.push_back(rest(k) > negligible * whole(k));
    if (is_left.back()) left.push_back(k);
  }
  check_requests(requests, is_left);
  if (left.empty()) return;

  const Eigen::VectorXd unit = rest.cwiseSqrt().cwiseInverse();
  fields.combine(Eigen::MatrixXd(unit.asDiagonal())(Eigen::all, left));
  fields.combine(independent_fields(inner_products(fields.shapes, matrices.stiffness_times(fields.shapes))));
  // Remainders of the modes after cancellation become visible in small vectors, so the modes are removed once more.
  remove_modes(matrices, basis, fields);
  const auto pairs = symmetric_eigenpairs(inner_products(fields.shapes, matrices.mass_times(fields.shapes)),
                                          inner_products(fields.shapes, matrices.stiffness_times(fields.shapes)));
  if (!pairs || pairs->values.minCoeff() <= 0)
    throw ComputationError(
        "the residual vectors have no positive mass and stiffness: a very distorted mesh may be the cause");
  const Eigen::VectorXd flexibilities = pairs->values.reverse();  // 1 / omega^2
  const Eigen::MatrixXd vectors = pairs->vectors.rowwise().reverse();
  fields.combine(vectors * flexibilities.cwiseSqrt().cwiseInverse().asDiagonal());
  fields.choose_signs();
  append_to_basis(fields, flexibilities.cwiseInverse(), basis);
}

}  // namespace bielle::reduce
