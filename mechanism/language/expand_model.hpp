// From a mechanism file that is written in parts to one in which every entry stands.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/language/tree.hpp"
#include "reduce/common/formula/expression.hpp"
#include "reduce/common/input/key_table.hpp"

namespace bielle::mechanism {

/// Options of a run that change the model.
struct ModelOptions {
  std::map<std::string, std::string> overrides;  ///< formulas of parameters by their names (`--set`)
  std::string chosen_case;                       ///< entry of `cases` (`--case`); empty: none
};

/// A model in which every entry is written out.
struct ExpandedModel {
  Tree root;
  Parameters parameters;
  bool is_changed = false;  ///< whether the file uses anything of the language
};

/// Expands `include`, `cases`, `if`, `repeat`, `parts` and points of bodies. The time grows with the number of entries
/// that result.
/// @param root  tree of the file, as it is written
/// @param file  its name
/// @param keys  keys of a mechanism file: the tables tell which texts are names, formulas and vectors
/// @throws InputError with the file and the line in which the error stands, and the path in the model
ExpandedModel expand_model(const Tree& root, const std::string& file, const KeyTable& keys,
                           const ModelOptions& options);

}  // namespace bielle::mechanism
