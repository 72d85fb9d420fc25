// The `loads` of a body file: patterns of load on its surface.
#pragma once

#include <string>

#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of a load.
const KeyTable& load_keys();

/// @param mesh  gets the surface. @throws InputError `file:line: key: what was expected`
LoadRequest read_load(const std::string& name, const YamlValue& value, MeshRequest& mesh);

}  // namespace bielle::reduce
