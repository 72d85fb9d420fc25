// Rotations of nodes that have no inertia, and on which no force or constraint acts: those of a point mass on springs,
// and that of a rod about its line between spherical joints.
#pragma once

#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct IdleRotations {
  int node = 0;
  std::vector<Vector3> axes;  ///< independent unit vectors, node axes
  bool all = false;           ///< about every axis through the node's origin
};

/// Finds motions of a node that move no mass and meet no stiffness, damping or constraint, neither where the model is
/// drawn nor in another position. A load is a force about an axis that these matrices do not show; the residual does.
/// @param nodes  to be looked at; a node needs three free rotations
/// @returns those that have such motions
std::vector<IdleRotations> idle_rotations(const System& system, const Environment& environment,
                                          const std::vector<int>& nodes);

}  // namespace bielle::mechanism
