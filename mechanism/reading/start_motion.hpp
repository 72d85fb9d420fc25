// How nodes move where a motion begins, and nodes that elements make between others: their start velocities follow from
// those.
//
// Velocities of carried and of driven nodes are known only when all of the file is read. An element therefore notes a
// rule that sets what it has made. Rules of beams may follow nodes that have rules of their own (points of
// superelements whose interfaces are points of others): all are followed several times, which serves lines of eight
// such bodies.
#pragma once

#include <functional>
#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// A node at the start: as drawn, with inertial components of its velocity [m/s] and angular velocity [rad/s].
struct StartMotion {
  Vector3 x, v, omega;
  /// The velocity of what moves rigidly with it at another place.
  Vector3 at(const Vector3& place) const { return v + omega.cross(place - x); }
};

/// As the file gives it; of a carried node by its carrier, of driven directions by their motion at time zero.
StartMotion start_motion(const Model& model, int node);

/// Sets a node's start velocity; what holds the node stays. @param motion  of the node, at its place
void set_start_motion(Model& model, int node, const StartMotion& motion);

/// Follows a rule when all entries are read. @param rule  sets velocities of nodes by those of others
void when_motion_is_known(Model& model, const std::function<void()>& rule);

}  // namespace bielle::mechanism
