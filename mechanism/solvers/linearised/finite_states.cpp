#include "mechanism/solvers/linearised/finite_states.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/linearised/modes.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_factors.hpp"

namespace bielle::mechanism {

MatrixX consistent_states(const LinearisedEquations& e, const VectorX& scale) {
  const int n = e.unknowns(), m = e.constraints(), dofs = e.dofs;
  if (m == 0) return MatrixX::Identity(e.states(), e.states());
  const MatrixX B = MatrixX(e.B), S = MatrixX(e.S), BW = MatrixX(LinearisedEquations::Sparse(e.B * e.W));
  MatrixX rows = MatrixX::Zero(2 * m, e.states());
  for (int k = 0; k < m; ++k) {
    if (e.nonholonomic[static_cast<std::size_t>(k)]) {
      rows.row(k).head(n) = S.row(k);
      rows.row(k).tail(dofs) = B.row(k).head(dofs);
    } else {
      rows.row(k).head(n) = B.row(k);
      rows.row(m + k).head(n) = -BW.row(k);
      rows.row(m + k).tail(dofs) = B.row(k).head(dofs);
    }
  }
  rows *= scale.asDiagonal();
  for (int k = 0; k < 2 * m; ++k)
    if (const double size = rows.row(k).norm(); size > 0) rows.row(k) /= size;
  constexpr double dependent = 1e-11;
  return null_space(rows, dependent);
}

namespace {

/// Tells whether every motion that the constraints allow has inertia, relative to that of its unknowns.
bool all_has_inertia(const LinearisedEquations& e, const VectorX& scale) {
  if (e.unknowns() != e.dofs) return false;
  constexpr double dependent = 1e-11, rounding = 1e-12;
  MatrixX rows = MatrixX(e.B) * scale.head(e.dofs).asDiagonal();
  for (int k = 0; k < e.constraints(); ++k)
    if (const double size = rows.row(k).norm(); size > 0) rows.row(k) /= size;
  const MatrixX allowed =
      scale.head(e.dofs).asDiagonal() *
      (e.constraints() > 0 ? null_space(rows, dependent) : MatrixX(MatrixX::Identity(e.dofs, e.dofs)));
  MatrixX mass = allowed.transpose() * MatrixX(e.M * allowed);
  mass.diagonal().array() -= rounding;  // M is scaled to a diagonal of ones
  return is_positive_definite(mass);
}

}  // namespace

Eigen::Index count_finite_eigenvalues(const LinearisedEquations& equations, const ShiftedOperator& T) {
  if (all_has_inertia(equations, T.scale())) return consistent_states(equations, T.scale()).cols();
  // Eigenvalues far from the shift appear infinite. A shift midway between the slowest and the fastest shows most of
  // them.
  Eigen::Index most = T.is_real() ? FiniteStates(equations, T).size() : 0;
  const ShiftedOperator middle(equations, std::sqrt(slowest_rate(equations) * fastest_rate(equations)));
  if (middle.regular()) most = std::max(most, FiniteStates(equations, middle).size());
  return most;
}

FiniteStates::FiniteStates(const LinearisedEquations& equations, const ShiftedOperator& T)
    : operator_(T), consistent_(consistent_states(equations, T.scale())), V_(consistent_) {
  MatrixX TV(V_.rows(), V_.cols());
  for (Eigen::Index k = 0; k < V_.cols(); ++k) TV.col(k) = T.apply(VectorX(V_.col(k)));
  Tf_ = V_.transpose() * TV;
  constexpr int most_stages = 3;  // infinite eigenvalues have chains of at most three states
  constexpr double rounding = 1e-15;
  for (int stage = 0; stage < most_stages && Tf_.rows() > 0; ++stage) {
    const RightSingularVectors left = right_singular_vectors(MatrixX(Tf_.transpose()));
    const double none = rounding * static_cast<double>(Tf_.rows()) * left.values[0];
    Eigen::Index rank = 0;
    while (rank < left.values.size() && left.values[rank] > none) ++rank;
    if (rank == Tf_.rows()) break;
    const MatrixX Q = left.vectors.leftCols(rank);
    const MatrixX row = Q.transpose() * Tf_;
    stages_.push_back({Q, row});
    Tf_ = row * Q;
    V_ = V_ * Q;
  }
}

VectorX FiniteStates::coordinates(const VectorX& p) const {
  VectorX c = consistent_.transpose() * p;
  const VectorX beyond = p - consistent_ * c;
  VectorX found = from_stage(0, c);
  // Forces without a response in these states leave rounding errors there, which the inverse would magnify.
  constexpr double rounding = 1e-12;
  if (beyond.norm() > rounding * p.norm())
    found += inverse_times(from_stage(0, VectorX(consistent_.transpose() * operator_.apply(beyond))));
  return found;
}

VectorX FiniteStates::from_stage(std::size_t stage, const VectorX& c) const {
  if (stage == stages_.size()) return c;
  const MatrixX& Q = stages_[stage].Q;
  const VectorX within = Q.transpose() * c;
  const VectorX coupled = stages_[stage].T * (c - Q * within);
  return from_stage(stage + 1, within) + inverse_times(from_stage(stage + 1, coupled));
}

VectorX FiniteStates::inverse_times(const VectorX& z) const {
  VectorX x(z.size());
  if (z.size() == 0) return x;
  LUFactors factors;
  factors.compute(Tf_);
  factors.solve(z, x);
  return x;
}

MatrixX FiniteStates::times_inverse(const MatrixX& rows) const {
  MatrixX x(Tf_.rows(), rows.rows());
  if (x.size() == 0) return x.transpose();
  LUFactors factors;
  factors.compute(MatrixX(Tf_.transpose()));
  factors.solve(MatrixX(rows.transpose()), x);
  return x.transpose();
}

}  // namespace bielle::mechanism
