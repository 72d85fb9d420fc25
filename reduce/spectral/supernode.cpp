#include "reduce/spectral/supernode.hpp"

namespace bielle {

namespace {

/// @param a  the first row of the panel in a matrix by columns, which are `stride` apart
template <class Number>
Number* copy_columns(const Number* a, std::int64_t stride, std::int64_t rows, std::int64_t columns, Number* to) {
  for (std::int64_t j = 0; j < columns; ++j, to += rows) std::copy_n(a + j * stride, rows, to);
  return to;
}

/// Its columns by columns, with inverses on the diagonal, and zeros above it.
template <class Number>
void copy_triangle(const Number* a, std::int64_t stride, std::int64_t rows, Number* to) {
  for (std::int64_t j = 0; j < rows; ++j, a += stride, to += rows) {
    std::fill_n(to, j, Number{0});
    to[j] = 1 / a[j];
    std::copy(a + j + 1, a + rows, to + j + 1);
  }
}

}  // namespace

template <class Number>
void Supernode<Number>::substitute_forwards(Number* own, const Vectors& vectors) const {
  for (std::int64_t row = 0; row < width; row += lines_abreast)
    FewVectors::fastest().substitute_forwards(own_panel(row), own, vectors);
}

template <class Number>
void Supernode<Number>::substitute_backwards(Number* own, const Vectors& vectors) const {
  for (std::int64_t row = (width - 1) / lines_abreast * lines_abreast; row >= 0; row -= lines_abreast)
    FewVectors::fastest().substitute_backwards(own_panel(row), own, vectors);
}

template <class Number>
void cut_into_panels(std::int64_t rows, std::int64_t width, Number* values, Number* room) {
  std::copy_n(values, rows * width, room);
  for (std::int64_t row = 0; row < width; row += lines_abreast) {
    const std::int64_t count = std::min<std::int64_t>(lines_abreast, width - row);
    Number* const triangle = copy_columns(room + row, rows, count, row, values + row * width);
    copy_triangle(room + row * (rows + 1), rows, count, triangle);
  }
  for (std::int64_t row = width; row < rows; row += lines_abreast)
    copy_columns(room + row, rows, std::min<std::int64_t>(lines_abreast, rows - row), width, values + row * width);
}

template struct Supernode<double>;
template struct Supernode<float>;
template void cut_into_panels(std::int64_t, std::int64_t, double*, double*);
template void cut_into_panels(std::int64_t, std::int64_t, float*, float*);

}  // namespace bielle
