// Which columns of a sparse matrix depend on those before them: rank-revealing QR by SPQR.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace bielle::mechanism {

/// Columns that are linear combinations of the columns to their left, ascending.
/// @param A          any shape
/// @param tolerance  a column counts as dependent when what is left of it after elimination is shorter than this
std::vector<int> dependent_columns(const Eigen::SparseMatrix<double>& A, double tolerance);

}  // namespace bielle::mechanism
