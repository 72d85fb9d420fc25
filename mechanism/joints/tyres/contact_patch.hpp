// The place at which a wheel touches the road, and the velocities there, as measures of the two nodes.
//
// The road is fixed on the first node: its frame J_A has z along the normal of the plane and, with a profile
// (road_profile.hpp), x along its length. The wheel is fixed on the second node: J_B is in its middle, z_B along its
// axis. With the unit normal n of the road at the nearest point, the distance d of the middle from the road there,
// c = n . z_B, s = sqrt(1 - c^2), and the direction from the lowest point of the rim to the middle m = (n - c z_B)/s:
//     deflection   r s - d
//     camber       c: sine of the angle of the wheel's plane with the normal
//     forward      t . v_2 at the middle, t = z_B x n/s: direction of a wheel that rotates about +z_B
//     roll         rho Omega: Omega = z_B . omega, with the rolling radius rho = (2 r + d/s)/3
//     longitudinal forward - roll: the slip velocity of the tread
//     lateral      l . v_2 at the point of the wheel's plane on the road, at d/s below its middle, l = n x t
//     spin         s m . omega: rate of the wheel's heading
// v and omega are those of the wheel relative to the road. The rolling radius of a tyre lies between its undeformed and
// its loaded radius; a third of the deflection is that of a tread which is pressed flat with a parabolic pressure.
#pragma once

#include "mechanism/joints/joint_frames.hpp"
#include "mechanism/joints/tyres/road_profile.hpp"

namespace bielle::mechanism {

/// Velocities are gradients w with their derivatives dw; their values are not used (PairMeasure::rate gives them).
template <int order>
struct ContactPatch {
  PairMeasureOf<order> deflection, camber;
  PairMeasureOf<order> longitudinal, lateral, roll, spin;
  double forward = 0;  ///< forward velocity of the middle [m/s]
};

/// Computes the deflection of the tyre [m], negative above the road. @param road  nullptr: a plane
PairSlope calc_deflection(const NodeState& first, const NodeState& second, const JointFrames& frames, double radius,
                          const RoadProfile* road);

/// Computes the patch, for orders 1 and 2.
/// @throws ComputationError, with a clause as its message, if the wheel lies flat on the road
template <int order>
ContactPatch<order> calc_patch(const NodeState& first, const NodeState& second, const JointFrames& frames,
                               double radius, const RoadProfile* road);

}  // namespace bielle::mechanism
