// Files that entries of a model name.
#pragma once

#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// What `read` makes of the file that a value names; faults of the file are told with the value's place.
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
