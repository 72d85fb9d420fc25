// Tables that entries of a model name as files, or write as rows.
#pragma once

#include <cstddef>
#include <string>

#include "mechanism/reading/read_file.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "reduce/common/files/table_file.hpp"

namespace bielle::mechanism {

/// Returns the columns of a file that the value names, or of a list of rows. @param count  number of columns
/// @param expected  a row in words, for messages: "[position, value]" @throws InputError
inline Eigen::MatrixXd read_rows(const YamlValue& value, std::size_t count, const std::string& expected) {
  const auto columns = static_cast<Eigen::Index>(count);
  if (!value.is_sequence())
    return read_named_file(value, [&](const std::string& path) { return read_table(path, columns); });
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(value.size()), columns);
  for (std::size_t k = 0; k < value.size(); ++k)
    rows.row(static_cast<Eigen::Index>(k)) = read_numbers(value.at(k), count, expected).transpose();
  return rows;
}

}  // namespace bielle::mechanism
