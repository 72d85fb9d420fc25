// Where walls of a body are a single element thick.
#pragma once

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Share of the surface [0, 1] from which one element leads to the opposite side of the body: its face lies on the
/// surface, its fourth corner on a part of the surface that looks the other way (by more than 120 degrees).
double share_one_element_thick(const Mesh& mesh);

}  // namespace bielle::reduce
