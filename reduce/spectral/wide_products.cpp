#include "reduce/spectral/wide_products.hpp"

#include <algorithm>

namespace bielle {

namespace {

/// Columns of A that follow each other and have the same rows below their diagonal block.
struct ColumnGroup {
  const std::int64_t* rows;
  std::int64_t count;
  const double* values[3];
  const double* x;  // all of X, and its rows of these columns
  const double* x_own[3];
  std::int64_t x_stride;
  double* y;
  double* y_own[3];
  std::int64_t y_stride;
};

using GroupProduct = void (*)(const ColumnGroup&);
using SumOfRows = void (*)(const double*, const int*, std::int64_t, const double*, std::int64_t, double*);

// A macro, since GCC decides how vectors are split in the function in which they are written. What stands in memory may
// begin anywhere.
#define BIELLE_WIDE_PRODUCTS(name, target_attribute, bytes)                                                            \
  using name##_piece = double __attribute__((vector_size(bytes), aligned(sizeof(double)), may_alias));                 \
  template <int columns, int quads>                                                                                    \
  target_attribute void name##_group(const ColumnGroup& g) {                                                           \
    constexpr int width = bytes / sizeof(double), pieces = vectors_in_quad * quads / width;                            \
    name##_piece x[columns][pieces], sum[columns][pieces];                                                             \
    for (int j = 0; j < columns; ++j)                                                                                  \
      for (int p = 0; p < pieces; ++p) {                                                                               \
        x[j][p] = *reinterpret_cast<const name##_piece*>(g.x_own[j] + p * width);                                      \
        sum[j][p] = *reinterpret_cast<const name##_piece*>(g.y_own[j] + p * width);                                    \
      }                                                                                                                \
    for (std::int64_t k = 0; k < g.count; ++k) {                                                                       \
      const double* const from = g.x + g.rows[k] * g.x_stride;                                                         \
      double* const to = g.y + g.rows[k] * g.y_stride;                                                                 \
      for (int p = 0; p < pieces; ++p) {                                                                               \
        const name##_piece there = *reinterpret_cast<const name##_piece*>(from + p * width);                           \
        name##_piece out = *reinterpret_cast<const name##_piece*>(to + p * width);                                     \
        for (int j = 0; j < columns; ++j) {                                                                            \
          out += g.values[j][k] * x[j][p];                                                                             \
          sum[j][p] += g.values[j][k] * there;                                                                         \
        }                                                                                                              \
        *reinterpret_cast<name##_piece*>(to + p * width) = out;                                                        \
      }                                                                                                                \
    }                                                                                                                  \
    for (int j = 0; j < columns; ++j)                                                                                  \
      for (int p = 0; p < pieces; ++p) *reinterpret_cast<name##_piece*>(g.y_own[j] + p * width) = sum[j][p];           \
  }                                                                                                                    \
  template <int pieces>                                                                                                \
  target_attribute void name##_strip(const double* factors, const int* rows, std::int64_t count, const double* x,      \
                                     std::int64_t width, double* y) {                                                  \
    constexpr int numbers = bytes / sizeof(double);                                                                    \
    name##_piece sum[pieces] = {};                                                                                     \
    for (std::int64_t k = 0; k < count; ++k)                                                                           \
      for (int p = 0; p < pieces; ++p)                                                                                 \
        sum[p] += factors[k] * *reinterpret_cast<const name##_piece*>(x + rows[k] * width + p * numbers);              \
    for (int p = 0; p < pieces; ++p) *reinterpret_cast<name##_piece*>(y + p * numbers) = sum[p];                       \
  }                                                                                                                    \
  target_attribute void name##_sum_of_rows(const double* factors, const int* rows, std::int64_t count,                 \
                                           const double* x, std::int64_t width, double* y) {                           \
    constexpr int numbers = bytes / sizeof(double);                                                                    \
    std::int64_t at = 0;                                                                                               \
    for (; at + 6 * numbers <= width; at += 6 * numbers) name##_strip<6>(factors, rows, count, x + at, width, y + at); \
    for (; at + 3 * numbers <= width; at += 3 * numbers) name##_strip<3>(factors, rows, count, x + at, width, y + at); \
    for (; at + numbers <= width; at += numbers) name##_strip<1>(factors, rows, count, x + at, width, y + at);         \
    for (; at < width; ++at) {                                                                                         \
      double sum = 0;                                                                                                  \
      for (std::int64_t k = 0; k < count; ++k) sum += factors[k] * x[rows[k] * width + at];                            \
      y[at] = sum;                                                                                                     \
    }                                                                                                                  \
  }                                                                                                                    \
  template <int columns>                                                                                               \
  GroupProduct name##_group_of(int quads) {                                                                            \
    return quads == 4   ? name##_group<columns, 4>                                                                     \
           : quads == 3 ? name##_group<columns, 3>                                                                     \
           : quads == 2 ? name##_group<columns, 2>                                                                     \
                        : name##_group<columns, 1>;                                                                    \
  }

BIELLE_WIDE_PRODUCTS(wide_anywhere, , 16)
#if defined(__x86_64__) && defined(__GNUC__)
BIELLE_WIDE_PRODUCTS(wide_avx2, __attribute__((target("avx2,fma"))), 32)
BIELLE_WIDE_PRODUCTS(wide_avx512, __attribute__((target("avx512f,avx512vl,avx2,fma"))), 32)  // twice as many registers
#endif

struct WideProducts {
  GroupProduct (*one)(int);
  GroupProduct (*three)(int);
  SumOfRows sum;
};

const WideProducts& wide_products() {
  static const WideProducts best = [] {
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"))
      return WideProducts{wide_avx512_group_of<1>, wide_avx512_group_of<3>, wide_avx512_sum_of_rows};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      return WideProducts{wide_avx2_group_of<1>, wide_avx2_group_of<3>, wide_avx2_sum_of_rows};
#endif
    return WideProducts{wide_anywhere_group_of<1>, wide_anywhere_group_of<3>, wide_anywhere_sum_of_rows};
  }();
  return best;
}

/// Whether columns j, j + 1 and j + 2 are those of a node: full on the diagonal, with the same rows below.
bool three_alike(const SymmetricMatrix& A, std::int64_t j) {
  if (j + 2 >= A.size) return false;
  const auto begin = [&](std::int64_t column) { return A.rows.begin() + A.starts[column]; };
  const std::int64_t below = A.starts[j + 3] - A.starts[j + 2] - 1;
  return A.starts[j + 2] - A.starts[j + 1] == below + 2 && A.starts[j + 1] - A.starts[j] == below + 3 &&
         A.rows[A.starts[j] + 1] == j + 1 && A.rows[A.starts[j] + 2] == j + 2 && A.rows[A.starts[j + 1] + 1] == j + 2 &&
         std::equal(begin(j) + 3, begin(j + 1), begin(j + 1) + 2) &&
         std::equal(begin(j) + 3, begin(j + 1), begin(j + 2) + 1);
}

}  // namespace

void add_symmetric_product(const SymmetricMatrix& A, int quads, const double* x, std::int64_t x_stride, double* y,
                           std::int64_t y_stride) {
  const GroupProduct one = wide_products().one(quads), three = wide_products().three(quads);
  const int width = vectors_in_quad * quads;
  ColumnGroup group{};
  group.x = x;
  group.x_stride = x_stride;
  group.y = y;
  group.y_stride = y_stride;
  for (std::int64_t j = 0; j < A.size;) {
    const int columns = three_alike(A, j) ? 3 : 1;
    for (int c = 0; c < columns; ++c) {
      group.x_own[c] = x + (j + c) * x_stride;
      group.y_own[c] = y + (j + c) * y_stride;
      group.values[c] = A.values.data() + A.starts[j + c] + columns - c;
    }
    for (int c = 0; c < columns; ++c)
      for (int r = c; r < columns; ++r) {
        const double entry = A.values[A.starts[j + c] + r - c];
        for (int p = 0; p < width; ++p) group.y_own[r][p] += entry * group.x_own[c][p];
        if (r == c) continue;
        for (int p = 0; p < width; ++p) group.y_own[c][p] += entry * group.x_own[r][p];
      }
    group.rows = A.rows.data() + A.starts[j] + columns;
    group.count = A.starts[j + 1] - A.starts[j] - columns;
    (columns == 3 ? three : one)(group);
    j += columns;
  }
}

void set_sum_of_rows(const double* factors, const int* rows, std::int64_t count, const double* x, std::int64_t width,
                     double* y) {
  wide_products().sum(factors, rows, count, x, width, y);
}

}  // namespace bielle
