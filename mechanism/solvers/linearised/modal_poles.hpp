// Contribution of each mode to the response of small motions: left and right vectors of the equations D(s) q = -r.
//
// D(s) is the matrix of the equations of motion and constraints, with q = [u; lambda] (equations.hpp,
// shifted_operator.hpp). With right and left vectors of an eigenvalue, D(s_j) v_j = 0 and y_j^T D(s_j) = 0, scaled to
// y_j^T D'(s_j) v_j = 1,
//     q(s) = -D(s)^-1 r = -sum_j v_j (y_j^T r) / (s - s_j) + smooth contributions of other modes and constraints,
// whether the equations are symmetric or not (P. Lancaster, Lambda-Matrices and Vibrating Systems, 1966, ch. 4).
// Vectors of different eigenvalues satisfy y_i^T (D(s_i) - D(s_j)) v_j = 0; those of equal ones are chosen to satisfy
// y_i^T D'(s) v_j = 0. If there are too few vectors (a defective eigenvalue), such a sum does not exist.
#pragma once

#include <complex>
#include <vector>

#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

struct ModalPole {
  std::complex<double> s;        ///< Im s >= 0; the other one of a pair has the conjugate vectors
  Eigen::VectorXcd right, left;  ///< (n + constraints)
};

/// Computes the poles of all modes that are not rigid.
/// @throws ComputationError if an eigenvalue is defective, or nearly so
std::vector<ModalPole> modal_poles(const LinearisedEquations& equations, const std::vector<Mode>& modes);

}  // namespace bielle::mechanism
