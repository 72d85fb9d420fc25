// `cases`: named sets of parameters and analyses.
#pragma once

#include <string>
#include <vector>

#include "mechanism/language/tree.hpp"
#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// Returns the names of the cases of a file, in its order.
std::vector<std::string> case_names(const Tree& root, const std::string& file);

/// Puts the parameters, analyses and output of a case in place of the file's.
/// @param keys    keys of a mechanism file
/// @param chosen  name of the case; empty: none
/// @returns the tree without `cases`
Tree with_case(const Tree& root, const std::string& file, const KeyTable& keys, const std::string& chosen);

}  // namespace bielle::mechanism
