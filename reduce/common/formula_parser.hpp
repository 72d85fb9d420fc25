// From text to tree: muParser reads the grammar and calls back for every operator, function and number.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reduce/common/formula_tree.hpp"

namespace bielle {

/// @param folder  where `table('file.csv', t)` looks for relative file names
/// @throws InputError: what is wrong, at which character (counted from 1)
FormulaTree parse_formula(const std::string& text, const std::vector<std::string>& variables,
                          const std::map<std::string, double>& constants, const std::string& folder);

}  // namespace bielle
