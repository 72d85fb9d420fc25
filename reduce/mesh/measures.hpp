// The volume of a mesh.
#pragma once

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Volume of the solid cells, curved or straight; exact up to rounding [m^3].
double mesh_volume(const Mesh& mesh);

}  // namespace bielle::reduce
