// Tables of numbers in text files (CSV): the columns of curves, profiles and studies.
#pragma once

#include <string>

#include <Eigen/Core>

namespace bielle {

/// Reads rows of numbers separated by commas, semicolons, tabs or blanks. Empty lines and the text after a `#` are
/// skipped; one heading line of words may precede the numbers.
/// @param columns  number of values that each row must have
/// @returns (rows, columns)
/// @throws InputError `file:line: what is wrong` if the file is missing, a row has another length, an entry is no
///         finite number, or there are no rows
Eigen::MatrixXd read_table(const std::string& path, Eigen::Index columns);

}  // namespace bielle
