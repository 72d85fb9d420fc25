// Reader of solids in the mechanism file, which define a rigid body.
#pragma once

#include "mechanism/elements/rigid_body/mass_properties.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the keys of a solid.
const KeyTable& solid_keys();
/// Reads a solid, or the sum of a list of solids, in the axes of the body's node:
// clang-format off
///   {box: [a, b, c] | sphere: r | cylinder: [r, length] | tube: [outer, inner, length] | cone: [below, above, length] |
///    ring: [radius, section], density: | mass:, position: [..], orientation key, cut: true}
// clang-format on
/// z is the axis of rotational symmetry, if there is one; `position` is the middle of the axis. The mass of solids with
/// `cut` is subtracted. Cuts without material (cut twice, or outside) give a warning. @throws InputError if nothing is
/// left, if the rest is not a valid body, or if a whole cut contains no material
MassProperties read_solids(const YamlValue& value);

/// Returns whether any of the solids gives its position.
bool solids_are_placed(const YamlValue& value);

}  // namespace bielle::mechanism
