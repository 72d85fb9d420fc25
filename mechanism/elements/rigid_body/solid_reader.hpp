// Solids in the mechanism file: what a rigid body is made of.
#pragma once

#include "mechanism/elements/rigid_body/mass_properties.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// A solid, or a list of solids added up, in the axes of the body's node:
// clang-format off
///   {box: [a, b, c] | sphere: r | cylinder: [r, length] | tube: [outer, inner, length] | cone: [below, above, length] |
///    ring: [radius, section], density: | mass:, position: [..], orientation key, cut: true}
// clang-format on
/// z is the axis of what turns about one; `position` is where the middle of the axis stands. The mass of what is `cut`
/// is taken away. Parts of it that are not
/// there (cut twice, or sticking out) are doubted. @throws InputError when nothing is left, when what is left is no
/// body, or when a whole cut finds nothing to cut
MassProperties read_solids(const YamlValue& value);

/// True when any of the solids says where it stands.
bool solids_are_placed(const YamlValue& value);

}  // namespace bielle::mechanism
