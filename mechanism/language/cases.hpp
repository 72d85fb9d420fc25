// `cases`: named sets of parameters and analyses.
#pragma once

#include <string>
#include <vector>

#include "mechanism/language/tree.hpp"

namespace bielle::mechanism {

/// Returns the names of the cases of a file, in its order.
std::vector<std::string> case_names(const Tree& root, const std::string& file);

/// Puts the parameters, analyses and output of a case in place of the file's.
/// @param chosen  name of the case; empty: none
/// @returns the tree without `cases`
Tree with_case(const Tree& root, const std::string& file, const std::string& chosen);

}  // namespace bielle::mechanism
