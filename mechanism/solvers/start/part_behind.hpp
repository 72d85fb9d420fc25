// The part behind a joint consists of the nodes that move with one of its sides if the joint itself is cut.
//
// Members with mass (beams, superelements) and constraints tie their nodes together. Others do not prevent the motion
// of the moving side relative to the rest: members with neither mass nor constraint (springs, contacts), and joints
// whose constraints permit this motion (a second bearing on the same axis). The part ends if only these members lead to
// held nodes; nodes that are connected to the part only by these members are behind the joint as well.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct PartBehind {
  std::vector<int> nodes;  ///< ascending; empty: it is connected to held nodes, or to the other side
  std::string way_back;    ///< in this case, the connecting members: "joint 'b', element 'link'"
};

/// @param joint   the member that is cut @param moving,base  its nodes: the moving one, and the other one
/// @param allows  whether a member's constraints permit the motion of the moving side
PartBehind part_behind(const System& system, std::size_t joint, int moving, int base,
                       const std::function<bool(std::size_t)>& allows);

/// Returns whether a node is held in all directions.
bool all_held(const Node& node);

}  // namespace bielle::mechanism
