// Detection of walls that are a single element thick.
#pragma once

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Share of the surface [0, 1] from which one element reaches the opposite side of the body: its face lies on the
/// surface, and one of its other corners on a part of the surface whose normal is turned by more than 120 degrees.
double share_one_element_thick(const Mesh& mesh);

}  // namespace bielle::reduce
