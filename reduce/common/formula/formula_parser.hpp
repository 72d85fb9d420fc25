// Makes a tree from text: muParser parses the grammar and calls back for every operator, function and number.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "reduce/common/formula/formula_tree.hpp"

namespace bielle {

/// @param shown   names of the variables in messages, one for each
/// @param folder  folder for relative file names in `table('file.csv', t)`
/// @throws InputError: the error and its position (counted from 1)
FormulaTree parse_formula(const std::string& text, const std::vector<std::string>& variables,
                          const std::vector<std::string>& shown, const std::map<std::string, double>& constants,
                          const std::string& folder);

/// Functions and `pi`.
const std::vector<std::string>& built_in_names();

/// Returns whether a name can stand in a formula without quotes: letters, digits and `_`, no digit first, or several
/// such words with dots between them.
bool is_dotted_word(const std::string& name);

/// Returns whether a name is among others.
inline bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace bielle
