#include "reduce/spectral/supernode.hpp"

namespace bielle {

namespace {

/// @param a  the first row of the panel in a matrix by columns, which are `stride` apart
double* copy_columns(const double* a, std::int64_t stride, std::int64_t rows, std::int64_t columns, double* to) {
  for (std::int64_t j = 0; j < columns; ++j, to += rows) std::copy_n(a + j * stride, rows, to);
  return to;
}

/// Its columns by columns, with inverses on the diagonal, and zeros above it.
void copy_triangle(const double* a, std::int64_t stride, std::int64_t rows, double* to) {
  for (std::int64_t j = 0; j < rows; ++j, a += stride, to += rows) {
    std::fill_n(to, j, 0.0);
    to[j] = 1 / a[j];
    std::copy(a + j + 1, a + rows, to + j + 1);
  }
}

}  // namespace

void Supernode::substitute_forwards(double* own, const Vectors& vectors) const {
  for (std::int64_t row = 0; row < width; row += lines_abreast)
    FewVectors::fastest().substitute_forwards(own_panel(row), own, vectors);
}

void Supernode::substitute_backwards(double* own, const Vectors& vectors) const {
  for (std::int64_t row = (width - 1) / lines_abreast * lines_abreast; row >= 0; row -= lines_abreast)
    FewVectors::fastest().substitute_backwards(own_panel(row), own, vectors);
}

void cut_into_panels(std::int64_t rows, std::int64_t width, double* values, double* room) {
  std::copy_n(values, rows * width, room);
  for (std::int64_t row = 0; row < width; row += lines_abreast) {
    const std::int64_t count = std::min<std::int64_t>(lines_abreast, width - row);
    double* const triangle = copy_columns(room + row, rows, count, row, values + row * width);
    copy_triangle(room + row * (rows + 1), rows, count, triangle);
  }
  for (std::int64_t row = width; row < rows; row += lines_abreast)
    copy_columns(room + row, rows, std::min<std::int64_t>(lines_abreast, rows - row), width, values + row * width);
}

}  // namespace bielle
