// Linear coordinates eps of a deformed body, in which its linear elasticity is formulated.
//
// The coordinates q of corotated_frame.hpp are the positions of the interfaces. Bending also moves the interfaces of a
// body to second order (the ends of a bent rod are closer than its length): the coordinates of the linear theory are
// larger by this amount,
//     q = eps - g(eps),   g_r = eps^T K_r eps / 2 for each interface row r,   0 for the modes,
// with K_r the geometric stiffness of the free body under a unit load along row r. The elastic energy
//     V = eps^T K~ eps / 2
// is a function of the present positions only, complete to third order in the deformation: its forces phi = dV/dq
// satisfy K~ eps + phi_r K_r eps = phi, the theory of second order under the present forces, and no memory is required.
// With G(x): rows r (K_r x)^T, zero for the modes,
//     deps = J dq,   J = (I - G(eps))^-1,   phi = J^T K~ eps,   dphi = J^T (K~ + phi_r K_r) J dq,
//     epsdot = J qdot,   eps'' = J (qddot + G(epsdot) epsdot).
// Only the rows of the interfaces are unknown. With the modes' part of G computed once, an iteration costs no more than
// products of the size of the interfaces.
#pragma once

#include "mechanism/elements/superelement/superelement_body_matrices.hpp"
#include "reduce/dense/small_lu.hpp"

namespace bielle::mechanism {

class LinearCoordinates {
 public:
  /// Solves q = eps - g(eps) by Newton's method. Only the first call allocates memory.
  /// @throws ComputationError if there is no solution near q: the body is then deformed beyond the range of the theory
  /// of second order
  void solve(const SuperelementMatrices& body, const VectorX& q);

  const VectorX& eps() const { return eps_; }
  /// Number of rows of interfaces; 0 for a body without geometric stiffness, whose eps is q.
  Eigen::Index rows() const { return gradient_.interfaces.rows(); }
  /// Returns the nonzero rows of J - I (rows, n). They are valid after set_excess.
  const MatrixX& excess() const { return excess_; }
  void set_excess();
  /// Computes the nonzero rows of J G(x), after set_excess. @param gradient  G(x)^T; @param product  (rows, n)
  void multiply_gradient(const PrestressGradient& gradient, MatrixX& product) const;
  /// v <- J v
  void multiply(VectorX& v) const;
  /// v <- J^T v
  void multiply_transposed(VectorX& v) const;

 private:
  /// Computes g(eps) and G(eps) in the rows of the interfaces.
  void set_shortening(const SuperelementMatrices& body);
  /// Factorises I - G(eps). @returns whether its determinant is positive
  bool factorise();

  VectorX eps_, step_, product_, sum_, shortening_, by_modes_;
  PrestressGradient gradient_;   ///< G(eps)^T
  MatrixX interfaces_by_modes_;  ///< the part of gradient_.interfaces due to the modes
  SmallLU factors_;              ///< factors of I - G(eps), rows of the interfaces
  MatrixX J_;                    ///< matrix that is factorised; after set_excess its inverse
  MatrixX excess_;
};

}  // namespace bielle::mechanism
