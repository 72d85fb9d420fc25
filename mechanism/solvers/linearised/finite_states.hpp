// The finite part of the linearised equations, without constraints: E z' = A z + B g in its own coordinates.
//
// With T = (A - sigma E)^-1 E (shifted_operator.hpp) the equations E x' = A x + g are T x' = x + sigma T x + p with p =
// (A - sigma E)^-1 g. States are the sum of the range of T^k, on which T is regular, and its null space, which contains
// the states due to constraints, massless directions and algebraic unknowns. With an orthonormal basis V of the range,
// T V = V T_f, and L with L T = T_f L, L V = 1, whose null space is that of T^k,
//     T_f z' = (1 + sigma T_f) z + L p,     x = V z.
// The range is found in stages (constraints first, then the rank of the remainder until it is regular); no inverse of a
// mass matrix is formed, so that slow eigenvalues remain accurate next to fast ones: to 1e-8 with rates that differ by
// a factor of a million, which is tested; with larger ratios more digits are lost.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {

/// Returns an orthonormal basis of the scaled states that satisfy the constraints and their rates.
MatrixX consistent_states(const LinearisedEquations& equations, const VectorX& scale);

/// Returns the number of finite eigenvalues of the equations: the degree of det D(s). Dense algebra is used.
/// @param T  operator at any shift
Eigen::Index count_finite_eigenvalues(const LinearisedEquations& equations, const ShiftedOperator& T);

class FiniteStates {
 public:
  /// @param T  operator at a real shift; it must outlive this object
  FiniteStates(const LinearisedEquations& equations, const ShiftedOperator& T);

  Eigen::Index size() const { return Tf_.rows(); }
  const MatrixX& V() const { return V_; }            ///< (states, size): scaled states of the coordinates
  const MatrixX& Tf() const { return Tf_; }          ///< (size, size), regular
  VectorX coordinates(const VectorX& p) const;       ///< L p for a scaled state p
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
