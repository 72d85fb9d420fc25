// Surfaces in a body file: physical groups by name, and shapes that select them.
#pragma once

#include <string>

#include "reduce/common/input/key_table.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle {
class YamlValue;
}

namespace bielle::reduce {

/// Returns the forms of a surface: a name, a shape, or a list of both.
KeyForms surface_forms();

/// Reads the surface of an interface, load or point and registers it.
/// @param key  key of the surface in its owner
/// @returns the name of its group in the mesh: that of the physical group, or "interfaces.<name>" if
///          shapes make a new one
std::string read_surface(const YamlValue& owner, const std::string& key, MeshRequest& request);

}  // namespace bielle::reduce
