// Constraints that repeat what others hold already: found, named and set aside.
//
// A planar mechanism of hinges, closed in space, is the everyday case. The columns of B^T (one per multiplier, scaled
// to length one in lengths of the model) are eliminated in the order of the file; a column that vanishes depends on
// those before it. Its row leaves the equations and its multiplier stays zero: the motion is unaffected, and the
// reactions are those of the joints that were written first.
#pragma once

#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Multipliers whose constraint depends on earlier ones at this state, ascending.
std::vector<int> find_redundant(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
