// Lists of a certain number of numbers in input files.
#pragma once

#include <cstddef>
#include <string>

#include "mechanism/math/types.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns a list of `count` numbers. @param expected  description for messages: "[radius, length]"
inline VectorX read_numbers(const YamlValue& value, std::size_t count, const std::string& expected) {
  if (!value.is_sequence() || value.size() != count) value.fail("expected " + expected);
  return value.vector();
}

}  // namespace bielle::mechanism
