// One place at which a journal (or ball) can touch the bush (or socket) of a joint with clearance, with all
// derivatives.
//
// The bush is fixed on the first node, with the joint's axes x, y, z (z along its bore); the journal on the second. In
// the axes of the bush, a point of the journal's axis is at s = [s_x, s_y, s_z].
//   bore     rho = [s_x, s_y, 0]:   p = |rho| - gap,   n = rho/|rho|
//   socket   rho = s:               p and n as for the bore
//   face     p = +-s_z - gap,       n = +-z, for the journal's collar on the end of the bush
//   faces    rho = [0, 0, s_z]:     p = |rho|, for collars without play on both ends, one of which always touches
// The penetration of the surfaces is p > 0. At the point of contact the journal's surface slides with
//     w = sdot + omega x r n,   without its part along n   (bore, socket; omega seen from the bush, r the journal's
//     radius) w = [sdot_x, sdot_y, r omega_z]                       (face: its centre, and the mean radius of its ring)
// Forces act along dp and dw, so that their power is exact. If rho = 0, there is neither a direction nor a force. The
// matrices are Y with w = Y v, and Z with dY^T f = Z(f) dz at fixed f.
#pragma once

#include <array>

#include "mechanism/joints/joint_frames.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/measures/pair_rotation.hpp"

namespace bielle::mechanism {

struct ClearancePlace {
  enum class Kind { bore, socket, face, faces };
  Kind kind = Kind::bore;
  double gap = 0;     ///< [m]
  double along = 0;   ///< position of the point on the journal's axis, from its origin [m]
  double side = 1;    ///< for a face: the end of the bush at +z or -z
  double radius = 0;  ///< radius r [m]
};

class ClearanceContact {
 public:
  using Rows = Eigen::Matrix<double, 3, 12>;
  /// @param frames  frames; they must outlive the contact
  ClearanceContact(const NodeState& first, const NodeState& second, const JointFrames& frames,
                   const ClearancePlace& place, const PairRotation& rotation, bool second_derivatives);
  const PairMeasure& p() const { return p_; }  ///< its derivatives are only valid if surfaces touch
  const Rows& Y() const { return Y_; }
  /// Returns the sliding part of w.
  Vector3 sliding(const Vector3& w) const { return w - n_ * n_.dot(w); }
  /// Returns the derivative of the sliding part through n, at fixed w.
  Rows turned_sliding(const Vector3& w) const;
  Matrix12 Z(const Vector3& f) const;

 private:
  ClearancePlace place_;
  const PairRotation& rotation_;
  std::array<PairMeasure, 3> s_;
  PairMeasure p_;
  Vector3 n_ = Vector3::Zero();  ///< zero for faces, whose w has no normal part
  Rows n_slope_ = Rows::Zero(), Y_ = Rows::Zero(), W_ = Rows::Zero();
};

}  // namespace bielle::mechanism
