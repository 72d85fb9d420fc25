// How well the linearised equations are known: what rounding may make of y^T D(s) x (equations.hpp).
//
// Entries are sums, which cancel: a rod between ball joints meets no stiffness about its axis, but rounding of its
// tension times its length. Each block of D that couples the translations, or the turns, of two nodes (all of one block
// are made together, whatever the axes) is known to a part eps of its norm, and errors of different blocks know nothing
// of each other:
//     delta^2 = sum_gh (eps |y_g| |D_gh| |x_h|)^2 + sum_g (|y_g| m_g |x_g|)^2,      eps = 64 * 2^-52.
// m_g stands for what the equilibrium is known to: forces are rounded, or have been left over by Newton's method, and
// reactions answer to them; m_g is the moment about a node of reactions that are made of them alone. An eigenvalue with
// the vectors y and x is then known to delta/|y^T D' x|, and a double one with one shape to (delta/|y^T D'' x/2|)^1/2
// (N. J. Higham, D. S. Mackey, F. Tisseur, SIAM J. Matrix Anal. Appl. 28 (2006) 1029).
#pragma once

#include <complex>
#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

class EquationRounding {
 public:
  explicit EquationRounding(const LinearisedEquations& equations);

  /// Takes note of reactions (constraints) that stand for nothing but errors of the equilibrium.
  void set_uncertain_reactions(const VectorX& reactions);
  /// delta. @param y, x  (n) in the unknowns of the equations
  double operator()(const Eigen::VectorXcd& y, std::complex<double> s, const Eigen::VectorXcd& x) const;

 private:
  using Sparse = LinearisedEquations::Sparse;
  Sparse norms(const Sparse& A) const;
  VectorX norms(const Eigen::VectorXcd& x) const;

  const LinearisedEquations& equations_;
  std::vector<int> group_;
  int groups_ = 0;
  Sparse K_, C_, M_;  ///< (groups, groups): norms of the blocks of D(s) that go with 1, s, s^2
  VectorX moments_;   ///< m (groups)
};

}  // namespace bielle::mechanism
