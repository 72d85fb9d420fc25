// `points` in a body file: named places inside the body, and residual vectors for loads on them.
//
//   points:
//     pad: {group: pad}                              # the mean of a surface
//     sensor: {at: [1.2, 0, 0.03]}                   # a place in the mesh
//     pin: {at: [0.3, 0, 0], residual: true}
//     hook: {group: hook, position: [0, 0, 1], residual: [x, z, ry]}
#pragma once

#include <array>
#include <vector>

#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of a point.
const KeyTable& point_keys();

/// `residual`: true, false or a list of directions. @throws InputError
std::array<bool, 6> read_residual(const YamlValue& value);

/// @param mesh  gets the surfaces
/// @throws InputError `file:line: key: what was expected`
std::vector<PointRequest> read_points(const YamlValue& value, MeshRequest& mesh);

}  // namespace bielle::reduce
