// Tables of keys: each type of thing in an input file declares its keys once, next to its reader.
//
// Everything that has to know the keys follows from the tables: refusal of unknown keys and of values out of range,
// units in values, defaults, `--keys`, the JSON schema for editors and the reference pages of the manual.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reduce/common/input/key_form.hpp"

namespace bielle {

/// Whether a key must be given, and the value that is taken if it is not.
struct Presence {
  bool required = false;
  std::string value;  ///< the default as it is written in a file, "[0, 0, 0]"; empty: there is none
  std::string words;  ///< the default in words if it is computed: "the distance as assembled"
};

/// One key of a map in an input file.
struct Key {
  std::string name;
  KeyForms forms;
  Presence presence;
  std::string about;                            ///< a sentence for the user, or several
  std::shared_ptr<const YamlNode> preset = {};  ///< the default's value, or null

  Key(std::string name, KeyForms forms, Presence presence, std::string about);
  Key(std::string name, KeyForm form, Presence presence, std::string about);
};

/// The keys of a map. Tables live as long as the program, since values of files refer to them.
struct KeyTable {
  /// A table that replaces this one in a map in which a key is present, or has a certain value.
  struct Variant {
    std::string key;
    std::string value;  ///< empty: the key is present, whatever its value
    const KeyTable& (*table)() = nullptr;
  };
  std::string of;     ///< the thing with its article, for messages: "a hinge"
  std::string about;  ///< a sentence for the user: what it is for
  std::vector<Key> keys;
  std::vector<Variant> variants = {};

  const Key* find(const std::string& name) const;  ///< null if the table has no such key
  std::vector<std::string> names() const;
  /// Returns the table of the variant that applies to a map, or this table if none does.
  const KeyTable& of_map(const YamlNode& map) const;
};

namespace keys {

const Presence required{true, {}, {}};
/// The key may be left out; its sentence says what that means.
const Presence optional{};
/// @param value  the default as it is written in a file
Presence otherwise(std::string value);
/// @param words  the default in words: "the distance as assembled"
Presence computed(std::string words);
std::vector<std::string> names_of(const std::vector<Key>& keys);
/// Returns the keys of several groups in their order.
std::vector<Key> joined(std::vector<std::vector<Key>> groups);

}  // namespace keys
}  // namespace bielle
