// JSON schema of an input file, which editors complete and check keys by.
#pragma once

#include <string>

#include "reduce/common/input/key_table.hpp"

namespace bielle {

/// Writes the JSON schema (draft 7) of a file whose keys are those of a table.
/// @param title  name of the kind of file: "mechanism file of bielle-mechanism"
std::string write_key_schema(const KeyTable& root, const std::string& title);

}  // namespace bielle
