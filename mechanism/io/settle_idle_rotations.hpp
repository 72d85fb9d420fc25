// Nodes whose rotations have no inertia and that nothing needs.
#pragma once

#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// Gives rotations without inertia on which nothing acts an equation: a node on which only point masses, springs,
/// cables, `distance` and `spherical` joints and loads act keeps its axes, and a rod between spherical joints does not
/// turn about its own line. Call it when all components have been created, before supports are. Other rotations without
/// inertia are left for the solvers to reject.
void settle_idle_rotations(Model& model);

}  // namespace bielle::mechanism
