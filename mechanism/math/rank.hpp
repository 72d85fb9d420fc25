// Which columns of a sparse matrix depend on those before them: rank-revealing QR by SPQR, at a cost that does not
// depend on the order of the columns.
//
// Elimination in the given order would answer at once, but its fill may grow with the square of the size: drives listed
// after all joints of a chain are enough. So the columns are eliminated in an order that keeps R sparse. Where the rank
// is full, nothing depends on anything. Otherwise each column a_j without a pivot gives a circuit, the coefficients by
// which others make it: R_11 y = r_j. The circuits span all vectors n with A n = 0, and a column depends on those
// before it when some n ends with it. These columns are the first independent ones of the matrix of circuits, counted
// from its last column (the dual of the matroid: J. Oxley, Matroid Theory, 2011, ch. 2).
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace bielle::mechanism {

/// Columns that are linear combinations of the columns to their left, ascending.
/// @param A          any shape; columns of length one or zero
/// @param tolerance  a column counts as dependent when what is left of it after elimination is shorter than this; in a
///                   combination of columns that vanishes, coefficients smaller than this relative to one count as zero
std::vector<int> dependent_columns(const Eigen::SparseMatrix<double>& A, double tolerance);

}  // namespace bielle::mechanism
