// The geometry of a body file: its file, the solids that are taken from it, and the elements into which it is meshed.
#pragma once

#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of `mesh`.
const KeyTable& mesh_keys();

/// Reads `geometry`, `length_unit`, `volume`, `volumes`, `glue` and `mesh`.
/// @param root  the body file @throws InputError `file:line: key: what was expected`
void read_mesh(const YamlValue& root, MeshRequest& request);

/// Replaces names of interfaces, loads, points and masses in `mesh.sizes` by those of their groups.
/// @throws InputError for a surface that gets two sizes
void resolve_sizes(const YamlValue& root, const ReductionOptions& options, MeshRequest& request);

}  // namespace bielle::reduce
