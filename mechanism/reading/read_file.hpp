// Files that entries of a model name.
#pragma once

#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Applies `read` to the file that a value names; errors in the file are reported with the value's position.
/// @param read  (path) -> result, throws InputError
template <class Read>
auto read_named_file(const YamlValue& value, const Read& read) {
  const std::string path = value.file_path();
  try {
    return read(path);
  } catch (const InputError& error) {
    value.fail(error.what());
  }
}

}  // namespace bielle::mechanism
