#include "reduce/spectral/few_columns.hpp"

#include <algorithm>

namespace bielle {

namespace {

/// Rows that are gone through at a time: their part of Y stays in the nearer caches.
constexpr std::int64_t strip_rows = 512;

/// A strip of A: some columns of it, `vectors` numbers of each row.
struct StripProduct {
  std::int64_t rows;
  const double* a;
  std::int64_t stride;
  double *x, *y;
  int row_stride;
};

using Product = void (*)(const StripProduct& work, int columns, int quads);

// Wide registers with fused multiplication are worth a multiple; the program runs without them as well. (A macro, since
// GCC decides how vectors are split in the function in which they are written. What stands in memory may begin
// anywhere.)
#define BIELLE_FEW_COLUMNS(name, target_attribute, bytes)                                                        \
  using name##_piece = double __attribute__((vector_size(bytes), aligned(sizeof(double)), may_alias));           \
  template <int columns, int quads>                                                                              \
  target_attribute void name##_plain(const StripProduct& work) {                                                 \
    constexpr int width = bytes / sizeof(double), pieces = vectors_abreast * quads / width;                      \
    name##_piece x[columns][pieces];                                                                             \
    for (int j = 0; j < columns; ++j)                                                                            \
      for (int p = 0; p < pieces; ++p)                                                                           \
        x[j][p] = *reinterpret_cast<const name##_piece*>(work.x + j * work.row_stride + p * width);              \
    for (std::int64_t i = 0; i < work.rows; ++i)                                                                 \
      for (int p = 0; p < pieces; ++p) {                                                                         \
        auto* const to = reinterpret_cast<name##_piece*>(work.y + i * work.row_stride + p * width);              \
        name##_piece sum = *to;                                                                                  \
        for (int j = 0; j < columns; ++j) sum -= work.a[i + j * work.stride] * x[j][p];                          \
        *to = sum;                                                                                               \
      }                                                                                                          \
  }                                                                                                              \
  template <int columns, int quads>                                                                              \
  target_attribute void name##_transposed(const StripProduct& work) {                                            \
    constexpr int width = bytes / sizeof(double), pieces = vectors_abreast * quads / width;                      \
    name##_piece x[columns][pieces];                                                                             \
    for (int j = 0; j < columns; ++j)                                                                            \
      for (int p = 0; p < pieces; ++p)                                                                           \
        x[j][p] = *reinterpret_cast<const name##_piece*>(work.x + j * work.row_stride + p * width);              \
    for (std::int64_t i = 0; i < work.rows; ++i)                                                                 \
      for (int p = 0; p < pieces; ++p) {                                                                         \
        const name##_piece y = *reinterpret_cast<const name##_piece*>(work.y + i * work.row_stride + p * width); \
        for (int j = 0; j < columns; ++j) x[j][p] -= work.a[i + j * work.stride] * y;                            \
      }                                                                                                          \
    for (int j = 0; j < columns; ++j)                                                                            \
      for (int p = 0; p < pieces; ++p)                                                                           \
        *reinterpret_cast<name##_piece*>(work.x + j * work.row_stride + p * width) = x[j][p];                    \
  }                                                                                                              \
  void name##_product(const StripProduct& work, int columns, int quads) {                                        \
    if (columns == 4)                                                                                            \
      quads == 3 ? name##_plain<4, 3>(work) : quads == 2 ? name##_plain<4, 2>(work) : name##_plain<4, 1>(work);  \
    else                                                                                                         \
      quads == 3 ? name##_plain<1, 3>(work) : quads == 2 ? name##_plain<1, 2>(work) : name##_plain<1, 1>(work);  \
  }                                                                                                              \
  void name##_transposed_product(const StripProduct& work, int columns, int quads) {                             \
    if (columns == 4)                                                                                            \
      quads == 3   ? name##_transposed<4, 3>(work)                                                               \
      : quads == 2 ? name##_transposed<4, 2>(work)                                                               \
                   : name##_transposed<4, 1>(work);                                                              \
    else                                                                                                         \
      quads == 3   ? name##_transposed<1, 3>(work)                                                               \
      : quads == 2 ? name##_transposed<1, 2>(work)                                                               \
                   : name##_transposed<1, 1>(work);                                                              \
  }

BIELLE_FEW_COLUMNS(anywhere, , 16)
#if defined(__x86_64__) && defined(__GNUC__)
BIELLE_FEW_COLUMNS(avx2, __attribute__((target("avx2,fma"))), 32)
BIELLE_FEW_COLUMNS(avx512, __attribute__((target("avx512f,avx512vl,avx2,fma"))), 32)  // twice as many registers
enum class Processor { anywhere, avx2, avx512 };
Processor processor() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) return Processor::avx512;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? Processor::avx2 : Processor::anywhere;
}
Product fastest_product() {
  const Processor is = processor();
  return is == Processor::avx512 ? avx512_product : is == Processor::avx2 ? avx2_product : anywhere_product;
}
Product fastest_transposed_product() {
  const Processor is = processor();
  return is == Processor::avx512 ? avx512_transposed_product
         : is == Processor::avx2 ? avx2_transposed_product
                                 : anywhere_transposed_product;
}
#else
Product fastest_product() { return anywhere_product; }
Product fastest_transposed_product() { return anywhere_transposed_product; }
#endif
#undef BIELLE_FEW_COLUMNS

/// Strip by strip, four columns of A and up to twelve vectors at a time.
void go_through(Product product, std::int64_t rows, std::int64_t columns, const double* a, std::int64_t stride,
                double* x, double* y, int vectors, int row_stride) {
  constexpr int most_quads = 3, columns_abreast = 4;
  for (std::int64_t first = 0; first < rows; first += strip_rows)
    for (std::int64_t j = 0; j < columns;) {
      const int width = columns - j >= columns_abreast ? columns_abreast : 1;
      for (int v = 0; v < vectors; v += most_quads * vectors_abreast)
        product({std::min(strip_rows, rows - first), a + first + j * stride, stride, x + j * row_stride + v,
                 y + first * row_stride + v, row_stride},
                width, std::min(most_quads, (vectors - v) / vectors_abreast));
      j += width;
    }
}

}  // namespace

void subtract_product_with_few(std::int64_t rows, std::int64_t columns, const double* a, std::int64_t stride,
                               const double* x, double* y, int vectors, int row_stride) {
  static const Product product = fastest_product();
  go_through(product, rows, columns, a, stride, const_cast<double*>(x), y, vectors, row_stride);
}

void subtract_transposed_product_with_few(std::int64_t rows, std::int64_t columns, const double* a, std::int64_t stride,
                                          const double* y, double* x, int vectors, int row_stride) {
  static const Product product = fastest_transposed_product();
  go_through(product, rows, columns, a, stride, x, const_cast<double*>(y), vectors, row_stride);
}

}  // namespace bielle
