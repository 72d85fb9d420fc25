// The finite part of the linearised equations, without constraints: E z' = A z + B g in coordinates of its own.
//
// With T = (A - sigma E)^-1 E (shifted_operator.hpp) the equations E x' = A x + g are T x' = x + sigma T x + p with
// p = (A - sigma E)^-1 g. States split into the range of T^k, where T is regular, and its null space, which holds what
// constraints, massless directions and algebraic unknowns add. With an orthonormal basis V of the first, T V = V T_f,
// and L, L T = T_f L, L V = 1, whose null space is the second,
//     T_f z' = (1 + sigma T_f) z + L p,     x = V z.
// The range is found in stages (constraints first, then the rank of what is left until it is regular); no inverse of
// a mass matrix is formed, so that slow eigenvalues keep their digits next to fast ones: 1e-8 of
// them with rates a million times apart, which is tested; farther apart they lose more.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {

/// An orthonormal basis of the scaled states that satisfy the constraints and their rates.
MatrixX consistent_states(const LinearisedEquations& equations, const VectorX& scale);

/// How many finite eigenvalues the equations have: the degree of det D(s). Dense algebra.
/// @param T  at some shift
Eigen::Index count_finite_eigenvalues(const LinearisedEquations& equations, const ShiftedOperator& T);

class FiniteStates {
 public:
  /// @param T  of a real shift; must outlive this
  FiniteStates(const LinearisedEquations& equations, const ShiftedOperator& T);

  Eigen::Index size() const { return Tf_.rows(); }
  const MatrixX& V() const { return V_; }            ///< (states, size): scaled states of the coordinates
  const MatrixX& Tf() const { return Tf_; }          ///< (size, size), regular
  VectorX coordinates(const VectorX& p) const;       ///< L p of a scaled state
  MatrixX times_inverse(const MatrixX& rows) const;  ///< rows T_f^-1

 private:
  /// The operator in coordinates [Q, N] is [Q^T T Q, Q^T T N; 0, 0].
  struct Stage {
    MatrixX Q;
    MatrixX T;  ///< Q^T T
  };
  VectorX from_stage(std::size_t stage, const VectorX& c) const;
  VectorX inverse_times(const VectorX& z) const;

  const ShiftedOperator& operator_;
  std::vector<Stage> stages_;
  MatrixX consistent_, V_, Tf_;
};

}  // namespace bielle::mechanism
