// Points of superelements in the mechanism file: nodes inside a body.
//
//   points:
//     tip: {element: blade, at: [1.2, 0, 0.03]}     # in the axes of the body's mesh
//     pad: {element: blade, point: pad}             # a point that the body file names
//
// A point can be used like any other node, for a load, the end of a spring, a joint or a sensor.
#pragma once

#include <optional>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the keys of an entry of `points`.
const KeyTable& point_keys();
/// Creates the nodes; they are attached to their bodies after all entries have been read.
/// @param elements  section `elements` of the file
void read_body_points(const YamlValue& points, const std::optional<YamlValue>& elements, Model& model);

}  // namespace bielle::mechanism
