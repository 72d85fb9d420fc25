// Beams in the mechanism file: a line between two nodes cut into elements (beam_element.hpp) of equal length.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& beam_keys();
/// `{type: beam, nodes: [a, b], section, elements, orientation, twist, damping, bending,
///   arc_centre | arc_through, distributed}` creates
///
/// elements - 1 internal nodes `<name>.1`, `<name>.2`, ..., whose axes are the section's, and one BeamElement each
/// between them, recorded together under elements/<name>, and a DistributedLoad for each load per length. The end nodes
/// keep their own axes: section frames are attached to them at their initial positions. The initial shape is free of
/// stress. A tapered section also varies within each element (ElementSections). Start velocities of the internal nodes
/// are interpolated between the rigid motions of the two ends.
void read_beam(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
