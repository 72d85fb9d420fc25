// The `masses` of a body file: rigid masses on surfaces or at places of the body, and mass per area.
#pragma once

#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of a mass.
const KeyTable& mass_keys();

/// @param value  the map of all masses @param mesh  gets the surfaces @param options  gets the masses and coatings
/// @throws InputError `file:line: key: what was expected`
void read_masses(const YamlValue& value, MeshRequest& mesh, ReductionOptions& options);

}  // namespace bielle::reduce
