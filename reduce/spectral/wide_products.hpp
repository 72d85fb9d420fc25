// Products of sparse matrices with several vectors whose rows are contiguous, in the widest registers of the processor.
// The program runs on all; which registers there are is found out when it runs.
#pragma once

#include <cstdint>

#include "reduce/spectral/symmetric_matrix.hpp"

namespace bielle {

constexpr int vectors_in_quad = 4, most_quads = 4;

/// Y += A X for 4, 8, 12 or 16 vectors: row i of X begins at x + i x_stride, that of Y at y + i y_stride.
void add_symmetric_product(const SymmetricMatrix& A, int quads, const double* x, std::int64_t x_stride, double* y,
                           std::int64_t y_stride);

/// y = sum_k factors[k] x_k, rows[k] being the number of row x_k of `width` numbers, one row after the other from x on.
void set_sum_of_rows(const double* factors, const int* rows, std::int64_t count, const double* x, std::int64_t width,
                     double* y);

}  // namespace bielle
