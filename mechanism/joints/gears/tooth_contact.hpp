// Where and along which normals the teeth of two wheels touch: what all gear meshes share.
//
// Three nodes: the carrier that the wheels' bearings stand on, wheel 1, wheel 2. In the axes of the carrier, as drawn:
// axes z_i, centres c_i, pitch point P, which is where the teeth touch, and at P
//     t   direction in which the teeth move that drive forwards, normal to the tooth traces, in the pitch plane
//     nu  normal of the pitch plane, away from wheel 1 (from the inside of a ring)
// The two flanks of a tooth have the normals (alpha the normal pressure angle)
//     n_+ = cos(alpha) t + sin(alpha) nu,   n_- = -cos(alpha) t + sin(alpha) nu
// both pointing from the flank of wheel 1 into wheel 2. The material of wheel i at P has moved along a direction e by
//     u_i(e) = e . (x_i - c_i) + ((P - c_i) x e) . (tau_i + z_i theta_i),
// x_i its centre as the carrier sees it, theta_i its angle about its axis counted over turns, tau_i = z_i x (present
// axis) its tilt. That is exact for any rotation of rigidly borne wheels, and of first order in what compliant bearings
// and shafts let them move relative to the carrier.
//
// Spur and helical, bevel and crossed wheels differ in t and nu alone (tooth_directions). Reference: A. Cardona,
// Three-dimensional gears modelling in multibody systems analysis, IJNME 40 (1997) 357-381, has wheels with flexible
// bearings in the same terms.
#pragma once

#include <array>

#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Derivatives along the increments of carrier, wheel 1, wheel 2.
using MeshMeasure = AutoDiff<18, 2>;

struct ToothGeometry {
  std::array<Vector3, 2> axis;    ///< z_i, unit, carrier's axes
  std::array<Vector3, 2> centre;  ///< c_i [m], carrier's axes
  std::array<Matrix3, 2> wheel;   ///< axes of a frame with z along z_i, in those of the wheel's node
  Vector3 P, t, nu;               ///< carrier's axes
  double pressure_angle;          ///< alpha [rad]
};

class ToothContact {
 public:
  explicit ToothContact(const ToothGeometry& geometry);
  const ToothGeometry& geometry() const { return geometry_; }
  /// u_1(e) - u_2(e): how far the teeth of wheel 1 have moved along e relative to those of wheel 2 [m].
  /// @param state  of a component whose nodes are carrier, wheel 1, wheel 2 and whose memory begins as below
  MeshMeasure approach(const Vector3& e, const LocalState& state) const;
  /// The force along t per torque about each wheel's axis: arms (P - c_i) x t . z_i [m], signed. Rates of the wheels
  /// are inverse to them.
  double arm(int wheel) const;

  // Memory: [angle, rate] of each wheel at the last accepted step, and its time.
  static constexpr int memories = 5;
  static void declare_memory(Declaration& declaration);
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const;
  /// Velocities and accelerations of the three nodes.
  static MeshMeasure::Gradient rates(const LocalState& state);
  static MeshMeasure::Gradient accelerations(const LocalState& state);

 private:
  PairMeasure displacement(int wheel, const Vector3& e, const LocalState& state) const;
  PairMeasure angle(int wheel, const LocalState& state) const;  ///< counted over turns
  ToothGeometry geometry_;
  std::array<Matrix3, 2> on_carrier_;  ///< frames with z along z_i that the wheels' frames coincide with as drawn
};

}  // namespace bielle::mechanism
