// Lists of numbers of a given length.
#pragma once

#include <cstddef>
#include <string>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Reads a list of `count` numbers. @param expected  description for messages: "[radius, length]"
inline Eigen::VectorXd read_numbers(const YamlValue& value, std::size_t count, const std::string& expected) {
  if (!value.is_sequence() || value.size() != count) value.fail("expected " + expected);
  return value.vector();
}

}  // namespace bielle::mechanism
