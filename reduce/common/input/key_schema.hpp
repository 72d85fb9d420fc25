// JSON schema of an input file, which editors complete and check keys by.
#pragma once

#include <map>
#include <string>

#include "reduce/common/input/key_table.hpp"

namespace bielle {

/// Keys and maps that files may contain in addition to the tables.
struct SchemaAdditions {
  std::vector<Key> entry_keys;  ///< keys that every named entry of a section may have
  std::map<std::string, const KeyTable& (*)()> in_place_of_names;  ///< maps in place of names of things: "node"
};

/// Writes the JSON schema (draft 7) of a file whose keys are those of a table.
/// @param title  name of the kind of file: "mechanism file of bielle-mechanism"
std::string write_key_schema(const KeyTable& root, const std::string& title, const SchemaAdditions& additions = {});

}  // namespace bielle
