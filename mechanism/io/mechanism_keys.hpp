// All keys of a mechanism file.
#pragma once

#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// The sections of a mechanism file, with everything below them.
const KeyTable& mechanism_file_keys();

/// An entry of the sections `elements` and `joints`: a variant for each type.
const KeyTable& element_keys();
const KeyTable& joint_keys();
/// An entry of the section `analysis`: a variant for each type.
const KeyTable& analysis_keys();

}  // namespace bielle::mechanism
