// Sparse symmetric matrices in CHOLMOD's format: the lower triangle by columns, 64-bit indices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace bielle {

/// Blocks of vectors with contiguous rows: a product with a sparse matrix then reads each entry once for all columns.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A sparse symmetric matrix A (size,size). Column j holds rows `rows[starts[j] .. starts[j+1])`, ascending; the
/// diagonal entry is the first and always present.
struct SymmetricMatrix {
  std::int64_t size = 0;
  std::vector<std::int64_t> starts{0};  ///< size + 1
  std::vector<std::int64_t> rows;
  std::vector<double> values;

  /// A x for a block of vectors (size,k); the columns are distributed over `threads`.
  RowMatrix multiply(const RowMatrix& x, int threads = 1) const;
  Eigen::VectorXd diagonal() const;
};

/// Returns the submatrix of A with the rows and columns `kept` (ascending).
SymmetricMatrix principal_submatrix(const SymmetricMatrix& a, std::span<const std::int64_t> kept);

/// Returns the matrix [A B; B^T C] with a few dense rows and columns appended. @param b (size,k); @param c (k,k)
/// symmetric
SymmetricMatrix bordered(const SymmetricMatrix& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& c);

/// Returns the lower triangle of a dense symmetric matrix without entries that are exactly zero (except on the
/// diagonal).
SymmetricMatrix sparse_lower(const Eigen::MatrixXd& a);

}  // namespace bielle
