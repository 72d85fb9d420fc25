// Accuracy of the linearised equations: the effect of rounding on y^T D(s) x (equations.hpp).
//
// Entries are sums with cancellation: a rod between ball joints has no stiffness about its axis, only rounding errors
// of its tension times its length. Each block of D that couples the translations, or the rotations, of two nodes (all
// entries of a block are computed together, for any axes) is accurate to a fraction eps of its norm, and errors of
// different blocks are independent:
//     delta^2 = sum_gh (eps |y_g| |D_gh| |x_h|)^2 + sum_g (|y_g| m_g |x_g|)^2,      eps = 64 * 2^-52.
// Here m_g represents the error of the equilibrium: forces are rounded, or have a residual of Newton's method, and
// reactions respond to them; m_g is the moment about a node of the reactions to these errors only. An eigenvalue with
// the vectors y and x is then accurate to delta/|y^T D' x|, and a double one with one shape to (delta/|y^T D''
// x/2|)^1/2 (N. J. Higham, D. S. Mackey, F. Tisseur, SIAM J. Matrix Anal. Appl. 28 (2006) 1029).
#pragma once

#include <complex>
#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

class EquationRounding {
 public:
  explicit EquationRounding(const LinearisedEquations& equations);

  /// Sets the reactions (constraints) that are due to errors of the equilibrium only.
  void set_uncertain_reactions(const VectorX& reactions);
  /// Returns delta. @param y, x  (n) in the unknowns of the equations
  double operator()(const Eigen::VectorXcd& y, std::complex<double> s, const Eigen::VectorXcd& x) const;

 private:
  using Sparse = LinearisedEquations::Sparse;
  Sparse norms(const Sparse& A) const;
  VectorX norms(const Eigen::VectorXcd& x) const;

  const LinearisedEquations& equations_;
  std::vector<int> group_;
  int groups_ = 0;
  Sparse K_, C_, M_;  ///< (groups, groups): norms of the blocks of D(s) that are multiplied by 1, s, s^2
  VectorX moments_;   ///< m (groups)
};

}  // namespace bielle::mechanism
