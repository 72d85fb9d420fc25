// One place where a journal (or ball) can touch the bush (or socket) that it has play in, with all derivatives.
//
// The bush rides on the first node, with the joint's axes x, y, z (z along its bore); the journal on the second. Seen
// from the bush, a point of the journal's axis is at s = [s_x, s_y, s_z].
//   bore     rho = [s_x, s_y, 0]:   p = |rho| - gap,   n = rho/|rho|
//   socket   rho = s:               likewise
//   face     p = +-s_z - gap,       n = +-z, of the journal's collar against the end of the bush
// p > 0 is how far surfaces press into each other. At the point of contact the journal's surface slides with
//     w = sdot + omega x r n,   less its part along n      (bore, socket; omega seen from the bush, r the journal's
//     radius) w = [sdot_x, sdot_y, r omega_z]                       (face: its centre, and the mean radius of its ring)
// Forces act along dp and dw, so that their power is theirs exactly. There is no direction where rho = 0, and no force.
// Rows Y with w = Y v, dY^T f = Z(f) dz at fixed f.
#pragma once

#include <array>

#include "mechanism/joints/joint_frames.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/measures/pair_rotation.hpp"

namespace bielle::mechanism {

struct ClearancePlace {
  enum class Kind { bore, socket, face };
  Kind kind = Kind::bore;
  double gap = 0;     ///< [m]
  double along = 0;   ///< where the point is on the journal's axis, from its origin [m]
  double side = 1;    ///< of a face: the end of the bush at +z or -z
  double radius = 0;  ///< r [m]
};

class ClearanceContact {
 public:
  using Rows = Eigen::Matrix<double, 3, 12>;
  /// @param frames  must outlive the contact
  ClearanceContact(const NodeState& first, const NodeState& second, const JointFrames& frames,
                   const ClearancePlace& place, const PairRotation& rotation, bool second_derivatives);
  const PairMeasure& p() const { return p_; }  ///< its derivatives only where surfaces touch
  const Rows& Y() const { return Y_; }
  /// What of w is sliding.
  Vector3 sliding(const Vector3& w) const { return w - n_ * n_.dot(w); }
  /// d(sliding)/dz by way of n, at fixed w.
  Rows turned_sliding(const Vector3& w) const;
  Matrix12 Z(const Vector3& f) const;

 private:
  ClearancePlace place_;
  const PairRotation& rotation_;
  std::array<PairMeasure, 3> s_;
  PairMeasure p_;
  Vector3 n_ = Vector3::Zero();  ///< zero of a face, whose w is all sliding
  Rows n_slope_ = Rows::Zero(), Y_ = Rows::Zero(), W_ = Rows::Zero();
};

}  // namespace bielle::mechanism
