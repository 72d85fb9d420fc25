// Finds the columns of a sparse matrix that depend on columns before them, by rank-revealing QR (SPQR), at a cost that
// does not depend on the order of the columns.
//
// Elimination in the given order would answer directly, but its fill may grow with the square of the size, for example
// if drives are listed after all joints of a chain. Therefore the columns are eliminated in an order that keeps R
// sparse. If the rank is full, no column depends on others. Otherwise each column a_j without a pivot gives a circuit,
// the coefficients of the linear combination of other columns that equals it: R_11 y = r_j. The circuits span all
// vectors n with A n = 0, and a column depends on those before it if the last entry of some n is at this column. These
// columns are the first independent ones of the matrix of circuits, counted from its last column (the dual of the
// matroid: J. Oxley, Matroid Theory, 2011, ch. 2).
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace bielle::mechanism {

/// Returns the columns that are linear combinations of the columns to their left, ascending.
/// @param A          any shape; columns of length one or zero
/// @param tolerance  a column is dependent if its remainder after elimination is shorter than this; in a vanishing
///                   combination of columns, coefficients smaller than this relative to one count as zero
std::vector<int> dependent_columns(const Eigen::SparseMatrix<double>& A, double tolerance);

}  // namespace bielle::mechanism
