// Mass, centre of mass and inertia of rigid bodies, for solids at any position and their sums.
//
//   Steiner: J_O = J_C - m c~ c~;     sum of bodies: m c = sum m_k c_k,  J_O = sum J_O,k
//   rotation by R: J -> R J R^T
#pragma once

#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

/// Mass properties of a rigid body, in the axes of some frame.
struct MassProperties {
  double mass = 0;                       ///< mass [kg]
  Vector3 centre = Vector3::Zero();      ///< centre of mass [m], from the frame's origin
  Matrix3 inertia = Matrix3::Zero();     ///< about the centre of mass [kg m^2]
  Matrix3 inertia_about_origin() const;  ///< about the frame's origin [kg m^2]
};

/// Combines two bodies into one.
MassProperties operator+(const MassProperties& a, const MassProperties& b);
/// Multiplies the mass of a body; a negative factor makes a cut-out.
MassProperties operator*(double factor, const MassProperties& body);
/// Transforms a body that is described in frame A to frame B. @param H_BA  frame A in B
MassProperties placed(const Frame& H_BA, const MassProperties& body);

// Homogeneous solids of density 1 kg/m^3 about the middle of their axis. Lengths are in [m], and z is the axis.
MassProperties box(const Vector3& edges);
MassProperties sphere(double radius);
MassProperties cylinder(double radius, double length);
MassProperties tube(double outer, double inner, double length);
/// Returns a frustum: radius `below` at z = -length/2, `above` at z = length/2; one of them may be zero.
MassProperties cone(double below, double above, double length);
/// Returns a torus: a circle of radius `section` rotated about the axis at the distance `radius`.
MassProperties ring(double radius, double section);

}  // namespace bielle::mechanism
