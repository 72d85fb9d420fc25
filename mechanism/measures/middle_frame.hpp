// The relative position and rotation of two frames as six measures, in the frame halfway between them.
//
// With the frames A on node 1 (origin p_A) and B on node 2 (p_B), C = R_A^T R_B the rotation between them and
//     psi = log C,   M = R_A exp(psi/2) = R_B exp(-psi/2):     u = M^T (p_B - p_A) - u_0,   psi.
// - A rigid motion of both frames leaves the measures unchanged, however large the rotation.
// - Exchanging the frames changes the signs of all six (with u_0): no node is preferred.
// - |u + u_0| is the distance of the points: a force along u, for a stiffness that is equal in all directions, acts
//   along the line between them, without a moment about either point.
// - psi has the same components in A, B and M. Relative rotations must stay below half a turn.
// With h = psi/2, d = R_A^T (p_B - p_A) and T the tangent operator of rotations,
//     u = exp(-h) d - u_0,   du = exp(-h) dd + (u + u_0) x T(h) dh.
// Reference for frames between two nodes: P. Masarati, M. Morandini, Intrinsic deformable joints, Multibody System
// Dynamics 23 (2010) 361-386.
#pragma once

#include <span>
#include <string>

#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/measures/pair_rotation.hpp"

namespace bielle::mechanism {

class MiddleFrame {
 public:
  /// @param A,B  frames in the axes of their nodes @param u_0  [m]
  MiddleFrame(const NodeState& first, const NodeState& second, const Frame& A, const Frame& B,
              const Vector3& u_0 = Vector3::Zero());
  /// The measures [u; psi].
  const Vector6& value() const { return value_; }
  /// Axes of M, in inertial components.
  const Matrix3& axes() const { return M_; }
  /// Computes the six measures with their first derivatives, and with the second if requested.
  void calc(std::span<PairMeasure, 6> measures, bool second) const;

 private:
  Matrix12 second(const Vector6& factor) const;  ///< sum_k factor_k S_k
  PairRotation rotation_;
  PointPair points_;
  Matrix3 A_, half_, T_, M_;  ///< half_ = exp(h), T_ = T(h)
  Vector3 h_, way_;           ///< way_ = u + u_0
  Vector6 value_;
  PairRotation::Gradients turn_;           ///< dpsi/dz
  Eigen::Matrix<double, 3, 12> approach_;  ///< dd/dz
};

/// Check at the end of a step: throws for relative rotations above 171 degrees, and for those that have passed half a
/// turn within the step, at which psi jumps to the opposite sign. @param who  "bushing 'mount'" @param before  psi of
/// the last step
/// @param advice  a sentence without its full stop @throws ComputationError
void check_half_turn(const LocalState& state, const std::string& who, const Vector3& psi, const Vector3& before,
                     const std::string& advice);

}  // namespace bielle::mechanism
