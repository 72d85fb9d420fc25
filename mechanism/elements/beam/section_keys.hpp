// Keys of cross sections of beams in the mechanism file.
#pragma once

#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// The keys of a section of a homogeneous shape with its material.
const KeyTable& shape_section_keys();
/// The keys of a section by its stiffness constants.
const KeyTable& constants_section_keys();
/// The keys of a section by 6x6 matrices.
const KeyTable& matrices_section_keys();
/// Returns the forms of the key `section` of a beam: one of these maps, or a pair of them.
KeyForms section_forms();

}  // namespace bielle::mechanism
