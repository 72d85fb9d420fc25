#include "reduce/matrices/matrix_basis.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/leading_component.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/matrices/reduce_matrices.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::reduce {

namespace {

constexpr double massless = 1e-14;  // eigenvalue of M_ii relative to its largest, or of 1/omega^2

/// Returns all modes with mass. With M = B B^T and the flexibility F of the held body, B^T F B w = omega^-2 w and
/// phi = omega^2 F B w. It needs neither a regular M nor a regular K.
Eigenpairs all_modes(const HeldMatrices& held) {
  const Eigen::Index n = held.size();
  Eigenpairs result;
  result.method = "dense algebra";
  const Eigen::MatrixXd mass = held.inertia(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd scale = mass.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd inverse = (scale.array() > 0).select(scale.cwiseInverse(), 0.0);
  const SymmetricEigenpairs masses = symmetric_eigenpairs(inverse.asDiagonal() * mass * inverse.asDiagonal());
  const Eigen::Index inertial = (masses.values.array() > massless * masses.values.cwiseAbs().maxCoeff()).count();
  if (inertial == 0) return result;  // all mass is at the interfaces
  const Eigen::MatrixXd root =
      scale.asDiagonal() * masses.vectors.rightCols(inertial) * masses.values.tail(inertial).cwiseSqrt().asDiagonal();
  const Eigen::MatrixXd moved = held.solve(root);
  const Eigen::MatrixXd compliance = transposed_product(root, moved);
  const SymmetricEigenpairs pairs = symmetric_eigenpairs((compliance + compliance.transpose()) / 2);
  const double least = massless * std::max(pairs.values.size() > 0 ? pairs.values.maxCoeff() : 0, 0.0);
  const Eigen::Index count = (pairs.values.array() > least).count();
  result.values = pairs.values.tail(count).reverse().cwiseInverse();
  result.vectors = product(moved, pairs.vectors.rightCols(count).rowwise().reverse());
  result.vectors = Eigen::MatrixXd(result.vectors * result.values.asDiagonal());
  for (Eigen::Index k = 0; k < count; ++k)
    if (leading_component(result.vectors.col(k)) < 0) result.vectors.col(k) *= -1;
  return result;
}

Eigenpairs modes_of(const HeldMatrices& held, const ModeRequest& request, Progress& progress, int threads) {
  if (held.size() <= most_unasked_modes) {
    check_mode_count(request, held.size());
    if (held.size() == 0 || request.count == 0) return {};
    Eigenpairs pairs = all_modes(held);
    keep_requested(request, pairs, progress);
    return pairs;
  }
  if (!request.any())
    throw InputError(
        fmt::format("the body has {} inside: tell how many modes to keep, by 'modes: {{count: 20}}' in a "
                    "body file with the key `matrices`",
                    counted(held.size(), "unknown")));
  const ShiftInvertProblem problem{held.size(), 0, [&](const Eigen::MatrixXd& b) { return held.solve(b); },
                                   [&](const Eigen::MatrixXd& z) { return held.inertia(z); }};
  const auto search = [&](int count, const EigenpairOptions& how) {
    return shift_invert_eigenpairs(problem, count, how);
  };
  return requested_modes(request, problem, search, progress, threads);
}

}  // namespace

MatrixBasis matrix_basis(const MatrixSet& set, const NodeTies& ties, const HeldMatrices& held,
                         const MatrixOptions& options, Progress& progress, int threads) {
  progress.start("constraint modes");
  const Eigen::Index kept = ties.carry.cols();
  const Eigen::MatrixXd loads = -Eigen::MatrixXd(ties.inside.transpose() * SparseColumns(set.stiffness * ties.carry));
  Eigen::MatrixXd averages = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(ties.averages.size()), kept);
  for (std::size_t k = 0; k < ties.averages.size(); ++k) averages(static_cast<Eigen::Index>(k), ties.averages[k]) = 1;
  const Eigen::MatrixXd answers = held.solve(loads, averages);

  progress.start("fixed-boundary modes");
  const Eigenpairs pairs = about(
      "modes", [&] { return modes_of(held, options.modes, progress, threads); }, Subject::hidden);
  MatrixBasis basis;
  basis.eigenvalues = pairs.values;
  basis.residuals = pairs.residuals;
  basis.method = pairs.method;
  basis.solves = pairs.solves;
  basis.sweeps = pairs.sweeps;
  basis.shapes.resize(set.size(), kept + pairs.values.size());
  basis.shapes.leftCols(kept) = ties.inside * answers + Eigen::MatrixXd(ties.carry);
  if (pairs.values.size() > 0) basis.shapes.rightCols(pairs.values.size()) = ties.inside * pairs.vectors;
  return basis;
}

}  // namespace bielle::reduce
