// Motion of nodes at the start, and of nodes that elements create between others: their start velocities follow from
// those.
//
// Velocities of carried and of driven nodes are known only after the whole file has been read. An element therefore
// registers a rule that sets the velocities of the nodes it has created. Rules of beams may depend on nodes that have
// rules of their own (points of superelements whose interfaces are points of others): all rules are applied several
// times, which is sufficient for chains of eight such bodies.
#pragma once

#include <functional>
#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// A node at the start: initial position, with inertial components of its velocity [m/s] and angular velocity [rad/s].
struct StartMotion {
  Vector3 x, v, omega;
  /// Returns the velocity of a point that moves rigidly with it.
  Vector3 at(const Vector3& place) const { return v + omega.cross(place - x); }
};

/// Returns the motion that the file gives. That of a carried node follows from its carrier, that of driven directions
/// from their prescribed motion at time zero.
StartMotion start_motion(const Model& model, int node);

/// Sets a node's start velocity; held directions are not changed. @param motion  motion of the node, at its position
void set_start_motion(Model& model, int node, const StartMotion& motion);

/// Applies a rule after all entries have been read. @param rule  sets velocities of nodes from those of others
void when_motion_is_known(Model& model, const std::function<void()>& rule);

}  // namespace bielle::mechanism
