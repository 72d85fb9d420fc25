// All keys of a mechanism file.
#pragma once

#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// Returns the table of the sections of a mechanism file, with everything below them.
const KeyTable& mechanism_file_keys();

/// Returns the table of an entry of the sections `elements` and `joints`: a variant for each type.
const KeyTable& element_keys();
const KeyTable& joint_keys();
/// Returns the table of an entry of the section `analysis`: a variant for each type.
const KeyTable& analysis_keys();

}  // namespace bielle::mechanism
