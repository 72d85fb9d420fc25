// Stress and other quantities that the file of another program recovers.
#pragma once

#include <map>

#include "reduce/matrices/matrix_options.hpp"
#include "reduce/matrices/matrix_set.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Gives rows of quantities the names that the user wants, and leaves out the rows that are not chosen.
/// @throws InputError about the key if there is no such quantity or row, or if the numbers of rows differ
void name_rows(const std::map<std::string, QuantityRows>& requests, RecoveredQuantities& quantities);

/// Adds stress at points and quantities to a reduced body. @param shapes  T (n, coordinates of the body)
void add_set_recovery(const MatrixSet& set, const Eigen::MatrixXd& shapes, Superelement& body);

}  // namespace bielle::reduce
