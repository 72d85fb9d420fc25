// Mass, centre of mass and inertia of rigid bodies: of solids, placed anywhere, and added up.
//
//   Steiner: J_O = J_C - m c~ c~;     sum of bodies: m c = sum m_k c_k,  J_O = sum J_O,k
//   turned by R: J -> R J R^T
// A distribution of positive mass has no negative principal moments, and none exceeds the sum of the two others.
#pragma once

#include <string>

#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

/// What a rigid body is made of, in the axes of some frame.
struct MassProperties {
  double mass = 0;                       ///< [kg]
  Vector3 centre = Vector3::Zero();      ///< of mass [m], from the frame's origin
  Matrix3 inertia = Matrix3::Zero();     ///< about the centre of mass [kg m^2]
  Matrix3 inertia_about_origin() const;  ///< about the frame's origin [kg m^2]
};

/// The two bodies as one.
MassProperties operator+(const MassProperties& a, const MassProperties& b);
/// The body with its mass multiplied; a negative factor makes a cut-out of others.
MassProperties operator*(double factor, const MassProperties& body);
/// The body at a frame: described in A, seen from B. @param H_BA  frame A in B
MassProperties placed(const Frame& H_BA, const MassProperties& body);

/// Why no body of positive mass has this inertia about its centre of mass, with its principal moments; empty when one
/// has. Moments of thin plates and rods lie on the bound and are rounded in input files: 0.1 % beyond it is accepted.
/// The moment of a line of mass about itself may be zero.
std::string inertia_fault(const Matrix3& inertia);

// Homogeneous solids of density 1 kg/m^3 about the middle of their axis. Lengths [m], z the axis.
MassProperties box(const Vector3& edges);
MassProperties sphere(double radius);
MassProperties cylinder(double radius, double length);
MassProperties tube(double outer, double inner, double length);
/// Frustum: radius `below` at z = -length/2, `above` at z = length/2; one of them may be zero.
MassProperties cone(double below, double above, double length);
/// Torus: a circle of radius `section` carried around the axis at the distance `radius`.
MassProperties ring(double radius, double section);

}  // namespace bielle::mechanism
