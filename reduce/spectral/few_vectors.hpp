// Products of a large matrix with a few vectors. General products of matrices (dgemm) copy the large matrix piece by
// piece before they use it, which takes as long as its use where there are few vectors; these read it once, in the
// order in which it stands in memory, and keep the vectors of a few of its rows or columns in registers.
//
// Vectors are by rows: the numbers of all vectors in row k stand next to each other, `stride` after those of row k - 1.
#pragma once

#include <cstdint>
#include <vector>

namespace bielle {

/// Rows of a panel, and columns of a tall matrix that are gone through at a time.
inline constexpr int lines_abreast = 8;
/// Vectors come in multiples of so many.
inline constexpr int vectors_abreast = 8;

/// The vectors of some rows: `count` numbers from the `first` on.
struct Vectors {
  int first, count, stride;
};

/// Some rows of a supernode of a factor by columns: the value in row i and column j is a[j * rows + i].
struct FactorPanel {
  int rows;              ///< 1 to `lines_abreast`
  std::int64_t columns;  ///< to the left of its triangle, where it has one
  const double* a;
};

/// Some columns of a matrix with many rows: the value in row i and column j is a[j * stride + i].
struct TallColumns {
  std::int64_t rows;
  int columns;  ///< 1 to `lines_abreast`
  const double* a;
  std::int64_t stride;
};

class FewVectors {
 public:
  /// For this processor: wide registers with fused multiplication are worth a multiple.
  static const FewVectors& fastest();
  /// All that run on this processor, the fastest last.
  static std::vector<const FewVectors*> all();

  /// y_i <- y_i - sum over j of a_ij x_j. @param y  addresses of its rows, which need not follow each other
  void subtract_product(const FactorPanel& panel, const double* x, double* const* y, const Vectors& vectors) const;
  /// x_j <- x_j - sum over i of a_ij y_i
  void subtract_transposed_product(const FactorPanel& panel, const double* const* y, double* x,
                                   const Vectors& vectors) const;
  /// Forward substitution in rows of the supernode's own, whose triangle T follows the columns to its left, with the
  /// inverses of its diagonal: y <- T^-1 (y - A x), where y are the rows of x that follow those of the panel's columns.
  void substitute_forwards(const FactorPanel& panel, double* x, const Vectors& vectors) const;
  /// Backward substitution: y <- T^-T y, then x <- x - A^T y.
  void substitute_backwards(const FactorPanel& panel, double* x, const Vectors& vectors) const;

  /// x_j <- x_j + sum over i of a_ij y_i
  void add_inner_products(const TallColumns& A, const double* y, double* x, const Vectors& vectors) const;
  /// y_i <- y_i + sum over j of a_ij x_j
  void add_product(const TallColumns& A, const double* x, double* y, const Vectors& vectors) const;

  struct Kernels;
  constexpr explicit FewVectors(const Kernels& kernels) : kernels_(kernels) {}

 private:
  const Kernels& kernels_;
};

}  // namespace bielle
