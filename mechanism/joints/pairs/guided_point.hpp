// A point of the second node on a line or a plane of the first; its rotation is free.
//
//   point_on_line    x_A . d = y_A . d = 0, z along `line`     coordinate `displacement`
//   point_on_plane   z_A . d = 0, z along `normal`             coordinates `x`, `y`
// d is the vector from the origin of J_A to that of J_B (lower_pairs.hpp contains the rows).
#pragma once

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

const KeyTable& point_on_line_keys();
void read_point_on_line(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& point_on_plane_keys();
void read_point_on_plane(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
