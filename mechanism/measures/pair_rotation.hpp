// The rotation vector of a frame on node 2 relative to a frame on node 1, as three coordinates.
//
// With C = A^T R_1^T R_2 B (components in B to components in A) and psi = log C: a motion of the nodes turns C by
// dphi = J dTheta from the left, J = A^T [-I, R_12] on [dTheta_1; dTheta_2], R_12 = R_1^T R_2, and
//     dpsi = T^-T(psi) dphi,   relative angular velocity along A's axes: omega = J [Omega_1; Omega_2].
// Sums of second derivatives are linear in a factor c of each coordinate: sum_k c_k S_k with d(dpsi_k/dz) = S_k dz, and
// sum_k c_k W_k with d(J_k) = W_k dz of the rates.
#pragma once

#include "mechanism/math/se3.hpp"
#include "mechanism/measures/coordinate.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class PairRotation {
 public:
  /// @param A,B  axes of the frames in the components of their nodes
  PairRotation(const NodeState& first, const NodeState& second, const Matrix3& A, const Matrix3& B);
  const Vector3& psi() const { return psi_; }
  Vector3 omega(const NodeState& first, const NodeState& second) const;
  using Gradients = Eigen::Matrix<double, 3, 12>;
  Gradients gradients() const;                                ///< gradients of psi: dpsi/dz
  Gradients rate_gradients() const;                           ///< J, over the twelve increments of the two nodes
  void add_second(const Vector3& c, Matrix12& S) const;       ///< sum_k c_k S_k
  void add_rate_second(const Vector3& c, Matrix12& W) const;  ///< sum_k c_k W_k
  /// Computes the coordinate psi[axis] with omega[axis] as its rate, on a local layout whose first twelve rows are
  /// those of the two nodes. @param jet  must be prepared
  void calc(int axis, const NodeState& first, const NodeState& second, CoordinateDerivatives& jet) const;
  void calc_slopes(int axis, const NodeState& first, const NodeState& second, CoordinateSlopes& slopes) const;

 private:
  Matrix3 A_, R_12_;
  Vector3 psi_;
};

}  // namespace bielle::mechanism
