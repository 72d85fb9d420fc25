// Parts of a mechanism that nothing joins to what is held.
#pragma once

#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// The first node of each part, ascending, that no element or joint connects with the ground or a node that is held in
/// some direction; nodes that nothing is attached to are none. Empty where nothing at all is held: that is a machine in
/// flight.
std::vector<int> loose_parts(const System& system);

}  // namespace bielle::mechanism
