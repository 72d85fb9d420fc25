// Products of a large matrix with a few vectors, as solutions with a factor need them. General products of matrices
// (dgemm) copy the large matrix piece by piece before they use it, which takes as long as its use where there are few
// vectors; these read it once, along its columns.
#pragma once

#include <cstdint>

namespace bielle {

/// Vectors come in multiples of so many.
inline constexpr int vectors_abreast = 4;

/// Y <- Y - A X. A (rows,columns) by columns that are `stride` apart; X and Y by rows that are `row_stride` apart, with
/// `vectors` numbers each, a multiple of `vectors_abreast`.
void subtract_product_with_few(std::int64_t rows, std::int64_t columns, const double* a, std::int64_t stride,
                               const double* x, double* y, int vectors, int row_stride);

/// X <- X - A^T Y.
void subtract_transposed_product_with_few(std::int64_t rows, std::int64_t columns, const double* a, std::int64_t stride,
                                          const double* y, double* x, int vectors, int row_stride);

}  // namespace bielle
