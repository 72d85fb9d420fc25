// The rotation vector of a frame on node 2 relative to a frame on node 1, as three coordinates.
//
// With C = A^T R_1^T R_2 B (components in B to components in A) and psi = log C: a motion of the nodes turns C by
// dphi = J dTheta from the left, J = A^T [-I, R_12] on [dTheta_1; dTheta_2], R_12 = R_1^T R_2, and
//     dpsi = T^-T(psi) dphi,   relative angular velocity along A's axes: omega = J [Omega_1; Omega_2].
#pragma once

#include "mechanism/math/se3.hpp"
#include "mechanism/measures/coordinate.hpp"
#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class PairRotation {
 public:
  /// @param A,B  axes of the frames in the components of their nodes
  PairRotation(const NodeState& first, const NodeState& second, const Matrix3& A, const Matrix3& B);
  const Vector3& psi() const { return psi_; }
  Vector3 omega(const NodeState& first, const NodeState& second) const;
  /// The coordinate psi[axis] with omega[axis] as its rate, on a local layout whose first twelve rows are those of the
  /// two nodes. @param jet  prepared
  void calc(int axis, const NodeState& first, const NodeState& second, CoordinateJet& jet) const;

 private:
  Matrix3 A_, R_12_;
  Vector3 psi_;
};

}  // namespace bielle::mechanism
