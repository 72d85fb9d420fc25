// Tables of numbers in text files (CSV): the columns of curves, profiles and studies.
#pragma once

#include <string>

#include <Eigen/Core>

namespace bielle {

/// Reads rows of numbers separated by commas, semicolons, tabs or blanks. Empty lines and what follows a `#` are
/// skipped; one heading line of words may stand before the numbers.
/// @param columns  how many numbers each row must hold
/// @returns (rows, columns)
/// @throws InputError `file:line: what is wrong` when the file is missing, a row has another length, something is no
///         finite number, or there are no rows
Eigen::MatrixXd read_table(const std::string& path, Eigen::Index columns);

}  // namespace bielle
