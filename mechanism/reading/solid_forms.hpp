// The forms of solids, which bodies have as mass and drawings as shapes.
#pragma once

#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Keys `box`, `sphere`, `cylinder`, `tube`, `cone` and `ring`, each a number or a list of lengths [m] in the order
/// that its text gives; all optional.
std::vector<Key> solid_form_keys();

}  // namespace bielle::mechanism
