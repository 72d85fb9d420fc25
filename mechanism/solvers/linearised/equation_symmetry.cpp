#include "mechanism/solvers/linearised/equation_symmetry.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = LinearisedEquations::Sparse;

/// Tells whether A^T = sign A. Each entry is compared relative to the diagonal, or to the whole matrix if the diagonal
/// is zero.
bool is_own_transpose(const Sparse& A, double sign, const VectorX& sizes) {
  constexpr double rounding = 1e-9;
  const Sparse difference = A - Sparse(sign * Sparse(A.transpose()));
  for (int j = 0; j < difference.outerSize(); ++j)
    for (Sparse::InnerIterator it(difference, j); it; ++it)
      if (std::abs(it.value()) > rounding * sizes[it.row()] * sizes[j]) return false;
  return true;
}

/// Returns the square roots of the sizes of rows and columns; a_ij is compared with s_i s_j.
VectorX roots_of_rows(const Sparse& A) {
  VectorX most = VectorX::Zero(A.rows());
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator it(A, j); it; ++it) {
      most[it.row()] = std::max(most[it.row()], std::abs(it.value()));
      most[j] = std::max(most[j], std::abs(it.value()));
    }
  return most.cwiseSqrt();
}

}  // namespace

Sparse stiffness_in_axes(const LinearisedEquations& e) { return e.K + Sparse(e.C * e.W); }
Sparse damping_in_axes(const LinearisedEquations& e) { return e.C + Sparse(e.M * e.W); }

bool has_symmetric_stiffness(const LinearisedEquations& e) {
  const bool rolls = std::any_of(e.nonholonomic.begin(), e.nonholonomic.end(), [](char each) { return each != 0; });
  if (rolls || e.unknowns() != e.dofs || e.F.nonZeros() > 0) return false;
  const Sparse K = stiffness_in_axes(e);
  return is_own_transpose(K, 1, roots_of_rows(K));
}

EquationSymmetry equation_symmetry(const LinearisedEquations& e) {
  if (!has_symmetric_stiffness(e) || !is_own_transpose(e.M, 1, roots_of_rows(e.M))) return EquationSymmetry::none;
  const Sparse C = damping_in_axes(e);
  const VectorX sizes = roots_of_rows(C);
  if (is_own_transpose(C, 1, sizes)) return EquationSymmetry::symmetric;
  return is_own_transpose(C, -1, sizes) ? EquationSymmetry::gyroscopic : EquationSymmetry::none;
}

Eigen::VectorXcd left_vector(const LinearisedEquations& e, std::complex<double> s, const Eigen::VectorXcd& u) {
  constexpr double next_to = 1e-7;
  constexpr int rounds = 3;
  for (const double factor : {1.0, 3.0, 10.0}) {
    const ShiftedOperator transposed(e, s * (1 + factor * next_to), ShiftedOperator::Side::left);
    if (!transposed.regular()) continue;
    const VectorX scale = transposed.scale().head(e.unknowns());
    // If one eigenvalue has several vectors, this start finds the one that pairs with u: y^T D' u ~ u^T u* of scaled
    // unknowns.
    Eigen::VectorXcd y = Eigen::VectorXcd::Zero(e.unknowns() + e.constraints());
    y.head(e.unknowns()) = u.conjugate();
    for (int round = 0; round < rounds; ++round) {
      Eigen::VectorXcd start = Eigen::VectorXcd::Zero(y.size());
      start.head(e.unknowns()) = y.head(e.unknowns()).cwiseQuotient(scale.cwiseAbs2().cast<std::complex<double>>());
      y = transposed.solve(start);
      const double size = y.head(e.unknowns()).cwiseQuotient(scale.cast<std::complex<double>>()).norm();
      if (!(size > 0) || !std::isfinite(size)) return {};
      y /= size;
    }
    return y;
  }
  return {};
}

}  // namespace bielle::mechanism
