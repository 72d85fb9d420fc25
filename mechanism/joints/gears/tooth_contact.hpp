// Position and normals of the contact between the teeth of two wheels: common base of all gear meshes.
//
// There are three nodes: the carrier of the wheels' bearings, wheel 1, wheel 2. In the initial axes of the carrier:
// axes z_i, centres c_i, pitch point P, at which the teeth touch, and at P
//     t   direction of motion of teeth that drive forwards, normal to the tooth traces, in the pitch plane
//     nu  normal of the pitch plane, away from wheel 1 (from the inside of a ring)
// The two flanks of a tooth have the normals (with the normal pressure angle alpha)
//     n_+ = cos(alpha) t + sin(alpha) nu,   n_- = -cos(alpha) t + sin(alpha) nu
// both pointing from the flank of wheel 1 into wheel 2. The material of wheel i at P has the displacement along a
// direction e
//     u_i(e) = e . (x_i - c_i) + ((P - c_i) x e) . (tau_i + z_i theta_i),
// with its centre x_i as seen from the carrier, its angle theta_i about its axis counted over turns, and its tilt tau_i
// = z_i x (present axis). This is exact for any rotation of rigidly supported wheels, and of first order in the motion
// relative to the carrier that compliant bearings and shafts permit.
//
// Spur and helical, bevel and crossed wheels differ only in t and nu (tooth_directions). Reference: A. Cardona,
// Three-dimensional gears modelling in multibody systems analysis, IJNME 40 (1997) 357-381, has wheels with flexible
// bearings in the same formulation.
#pragma once

#include <array>

#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Derivatives along the increments of carrier, wheel 1, wheel 2: of order 1 for residuals, of order 2 for tangents.
template <int order>
using MeshMeasureOf = AutoDiff<18, order>;
using MeshMeasure = MeshMeasureOf<2>;
using MeshSlope = MeshMeasureOf<1>;

struct ToothGeometry {
  std::array<Vector3, 2> axis;    ///< z_i, unit vectors, carrier's axes
  std::array<Vector3, 2> centre;  ///< c_i [m], carrier's axes
  std::array<Matrix3, 2> wheel;   ///< axes of a frame with z along z_i, in those of the wheel's node
  Vector3 P, t, nu;               ///< in the carrier's axes
  double pressure_angle;          ///< alpha [rad]
};

class ToothContact {
 public:
  explicit ToothContact(const ToothGeometry& geometry);
  const ToothGeometry& geometry() const { return geometry_; }
  /// Computes u_1(e) - u_2(e): displacement of the teeth of wheel 1 along e relative to those of wheel 2 [m].
  /// @param state  state of a component whose nodes are carrier, wheel 1, wheel 2 and whose memory begins as below
  template <int order>
  MeshMeasureOf<order> approach(const Vector3& e, const LocalState& state) const;
  /// Computes theta_i of a wheel (0 or 1), counted over turns.
  template <int order>
  MeshMeasureOf<order> turned(int wheel, const LocalState& state) const;
  /// Returns the signed lever arm (P - c_i) x t . z_i of a wheel [m], its torque about the axis per force along t.
  /// Rates of the wheels are inversely proportional to them.
  double arm(int wheel) const;

  // Memory: [angle, rate] of each wheel at the last accepted step, and its time.
  static constexpr int memories = 5;
  static void declare_memory(Declaration& declaration);
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const;
  /// Returns velocities and accelerations of the three nodes.
  static MeshMeasure::Gradient rates(const LocalState& state);
  static MeshMeasure::Gradient accelerations(const LocalState& state);

 private:
  template <int order>
  PairMeasureOf<order> displacement(int wheel, const Vector3& e, const LocalState& state) const;
  template <int order>
  PairMeasureOf<order> angle(int wheel, const LocalState& state) const;  ///< counted over turns
  ToothGeometry geometry_;
  std::array<Matrix3, 2> on_carrier_;  ///< frames with z along z_i that initially coincide with the wheels' frames
};

}  // namespace bielle::mechanism
