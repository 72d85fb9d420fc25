// Finds parts of a mechanism that are not connected to any held node.
#pragma once

#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the first node of each part, ascending, that no element or joint connects with the ground or with a node
/// that is held in some direction; nodes without any component are omitted. The list is empty if nothing at all is
/// held: the mechanism is then in free flight.
std::vector<int> loose_parts(const System& system);

}  // namespace bielle::mechanism
