// Keys of the language by which a mechanism is built from parts. They are read before all others and do not reach the
// readers of entries.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// Sections whose entries have names, in the usual order; `hydraulics` has lists of them.
const std::vector<std::string>& sections_of_entries();
/// Keys that every entry of a section may have: `if`, `repeat`.
std::vector<Key> entry_keys();
const KeyTable& repeat_keys();
/// Returns the table of a placed part: an entry of the section `parts`.
const KeyTable& part_keys();
/// Returns the table of a point of a body, in place of the name of a node.
const KeyTable& body_point_keys();

}  // namespace bielle::mechanism
