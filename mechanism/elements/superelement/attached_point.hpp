// A node of the mechanism that is fixed on a point inside a superelement, for a load, the end of a spring, or a sensor.
//
// The point moves with the reduced displacement field: T_P (6,n) gives its displacement and its rotation, body axes, in
// terms of the linear coordinates. Six constraints with multipliers lambda (force, moment on the body; body axes) hold
// the node at the point,
//     Phi = [y - X; log E] - T_P eps,    y = R_0^T (x - x_0),   E = R_0^T R R_ref^T,
// in the notation of corotated_frame.hpp. With the motion delta = dz^ - U_c dnu_0 of the node's triads relative to the
// frame, and D of the node's rotation,
//     dPhi = diag(I, D) delta - T_P deps,
// so that B^T lambda is m = diag(I, D^T) lambda on the node's triads, -T_P^T lambda on eps, and the wrench -U_c^T m on
// the frame. The body's compliance at the point is that of the basis.
#pragma once

#include "mechanism/elements/superelement/superelement_body_motion.hpp"

namespace bielle::mechanism {

/// A point of a body.
struct PointPlace {
  Vector3 X = Vector3::Zero();          ///< [m] in the undeformed body, body axes
  Matrix3 R_ref = Matrix3::Identity();  ///< node axes -> body axes in the undeformed body
  MatrixX T;                            ///< T_P (6,n), in the layout of SuperelementMatrices
};

/// A point at a state, relative to its body.
class AttachedPoint {
 public:
  /// @param motion  motion of the body, after set_motion
  AttachedPoint(const PointPlace& place, const SuperelementMotion& motion, const NodeState& node,
                const Vector6& multiplier, const Vector3& gravity);

  Vector6 gap() const;  ///< Phi
  Vector6 gap_rate() const;
  Vector6 gap_acceleration() const;
  const Vector6& node_force() const { return m_; }  ///< m: forces on the node's triads, body axes
  Vector6 wrench() const;                           ///< U_c^T m
  VectorX body_force() const { return place_.T.transpose() * multiplier_; }  ///< T_P^T lambda

  const MatrixX& shapes() const { return place_.T; }

  /// Adds the derivatives of forces and constraints.
  /// @param multiplier_row  row of the six multipliers in the target
  /// @param frame   dnu_0 per local unknown (6, size)
  /// @param node    motion of the node's triads, body axes, per local unknown (6, size)
  /// @param shape   T_P deps per local unknown (6, size)
  void add_tangent(int multiplier_row, const Matrix6X& frame, const Matrix6X& node, const Matrix6X& shape,
                   Eigen::Ref<MatrixX> target) const;

 private:
  const PointPlace& place_;
  const SuperelementMotion& motion_;
  Vector6 multiplier_, m_;
  Vector3 y_;
  Matrix3 E_, D_;
  Vector6 w_rel_, a_rel_;
};

}  // namespace bielle::mechanism
