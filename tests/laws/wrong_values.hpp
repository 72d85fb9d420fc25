// Values of keys that the tables of keys do not allow.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/key_table.hpp"
#include "reduce/common/input/yaml_node.hpp"

namespace bielle::laws {

/// Tells whether a value has one of the forms of its key, in kind, range, choice and number of items, at any depth.
/// Names, texts and formulas are not judged.
bool is_allowed(const KeyForms& forms, const YamlNode& value);

/// A key that occurs in a sample, at any depth, with the contents of its table.
struct ShownKey {
  std::string path;  ///< "section.young", "solid.0.box": items of lists are counted from 0
  const Key* key = nullptr;
  const YamlNode* value = nullptr;
};
/// Returns the keys below a value. Names that the user chooses are none.
std::vector<ShownKey> shown_keys(const KeyForms& forms, const YamlNode& value);

/// A value that a key does not allow.
struct WrongValue {
  std::string text;  ///< YAML; empty: the key is left out
  std::string says;  ///< what the message has to say; may be empty
};
/// Returns values that a key does not allow: out of range, with a wrong unit, with an item too few or too many, no word
/// of its choice; and that it is left out, if it must not be.
/// @param shown  its value in the sample
std::vector<WrongValue> wrong_values(const Key& key, const YamlNode& shown);

}  // namespace bielle::laws
