// Nodes whose rotations have no inertia and are not determined by any component.
#pragma once

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// Adds equations for rotations that have no inertia and on which nothing acts. A node on which only point masses,
/// springs, cables, `distance` and `spherical` joints and loads act keeps its axes, and a rod between spherical joints
/// does not turn about its own line. Call it when all components have been created, and before supports are created.
/// Other rotations without inertia are left for the solvers to reject.
void settle_idle_rotations(Model& model);

}  // namespace bielle::mechanism
