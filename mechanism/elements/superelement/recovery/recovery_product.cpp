#include "mechanism/elements/superelement/recovery/recovery_product.hpp"

#include <algorithm>
#include <cstdint>

#include <omp.h>

namespace bielle::mechanism {

void FrameBlock::reset(Eigen::Index coordinates, int frames) {
  coordinates_ = coordinates;
  frames_ = frames;
  constexpr std::size_t line = 64, per_line = line / sizeof(double);  // [bytes], number of values
  values_.assign(static_cast<std::size_t>(groups() * frames_abreast * coordinates) + per_line, 0.0);
  const std::size_t beyond = reinterpret_cast<std::uintptr_t>(values_.data()) % line;
  begin_ = beyond == 0 ? 0 : static_cast<Eigen::Index>((line - beyond) / sizeof(double));
}

void FrameBlock::set(int frame, const double* q) {
  double* to =
      values_.data() + begin_ + (frame / frames_abreast) * frames_abreast * coordinates_ + frame % frames_abreast;
  for (Eigen::Index k = 0; k < coordinates_; ++k) to[k * frames_abreast] = q[k];
}

namespace {

using Multiply = void (*)(const double* matrix, Eigen::Index coordinates, Eigen::Index count, const double* group,
                          double* values);

// The program runs on any x86-64, but wide registers with fused multiplication are several times faster here. Therefore
// the product is compiled for several processors, each with as many rows as fit with their sums in its registers. (It
// is a macro, since GCC decides how vectors are split in the function in which they are written, before it inlines.
// Data in memory may have any alignment.)
#define BIELLE_MULTIPLY(name, target_attribute, bytes, most_rows)                                                     \
  using name##_piece = double __attribute__((vector_size(bytes), aligned(sizeof(double)), may_alias));                \
  template <int rows>                                                                                                 \
  target_attribute void name##_rows(const double* matrix, Eigen::Index coordinates, const double* group,              \
                                    double* values) {                                                                 \
    constexpr int width = bytes / sizeof(double), pieces = frames_abreast / width;                                    \
    name##_piece sums[rows][pieces];                                                                                  \
    for (int p = 0; p < pieces; ++p) {                                                                                \
      const name##_piece q = *reinterpret_cast<const name##_piece*>(group + p * width);                               \
      for (int i = 0; i < rows; ++i) sums[i][p] = matrix[i * coordinates] * q;                                        \
    }                                                                                                                 \
    for (Eigen::Index k = 1; k < coordinates; ++k)                                                                    \
      for (int p = 0; p < pieces; ++p) {                                                                              \
        const name##_piece q = *reinterpret_cast<const name##_piece*>(group + k * frames_abreast + p * width);        \
        for (int i = 0; i < rows; ++i) sums[i][p] += matrix[i * coordinates + k] * q;                                 \
      }                                                                                                               \
    for (int i = 0; i < rows; ++i)                                                                                    \
      for (int p = 0; p < pieces; ++p)                                                                                \
        *reinterpret_cast<name##_piece*>(values + i * frames_abreast + p * width) = sums[i][p];                       \
  }                                                                                                                   \
  target_attribute void name(const double* matrix, Eigen::Index coordinates, Eigen::Index count, const double* group, \
                             double* values) {                                                                        \
    Eigen::Index r = 0;                                                                                               \
    for (; r + most_rows <= count; r += most_rows)                                                                    \
      name##_rows<most_rows>(matrix + r * coordinates, coordinates, group, values + frames_abreast * r);              \
    for (; r < count; r += 3)                                                                                         \
      name##_rows<3>(matrix + r * coordinates, coordinates, group, values + frames_abreast * r);                      \
  }

BIELLE_MULTIPLY(multiply_anywhere, , 16, 3)
#if defined(__x86_64__) && defined(__GNUC__)
BIELLE_MULTIPLY(multiply_avx2, __attribute__((target("avx2,fma"))), 32, 6)
BIELLE_MULTIPLY(multiply_avx512, __attribute__((target("avx512f,avx2,fma"))), 64, 12)
Multiply fastest_multiply() {
  if (__builtin_cpu_supports("avx512f")) return multiply_avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return multiply_avx2;
  return multiply_anywhere;
}
#else
Multiply fastest_multiply() { return multiply_anywhere; }
#endif
#undef BIELLE_MULTIPLY

}  // namespace

void multiply_rows(const RecoveryMatrix& matrix, Eigen::Index begin, Eigen::Index count, const double* group,
                   double* values) {
  static const Multiply multiply = fastest_multiply();
  multiply(matrix.data() + begin * matrix.cols(), matrix.cols(), count, group, values);
}

int recovery_threads(Eigen::Index rows, Eigen::Index coordinates, int frames) {
  constexpr double worth = 1e6;  // multiplications that justify a further thread, some 0.1 ms
  const double work = static_cast<double>(rows) * static_cast<double>(coordinates) * frames;
  return std::clamp(static_cast<int>(work / worth), 1, omp_get_max_threads());
}

}  // namespace bielle::mechanism
