// Groups of unknowns have one unit and mix when axes rotate: the translations of a node are a group, its rotations
// another, and every other unknown is a group of its own.
#pragma once

#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// @param count  number of unknowns, the dofs first (System)
/// @returns the group of each, ascending from 0
std::vector<int> unknown_groups(const System& system, int count);

}  // namespace bielle::mechanism
