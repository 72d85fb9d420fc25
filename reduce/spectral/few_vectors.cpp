#include "reduce/spectral/few_vectors.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

namespace bielle {

namespace {

/// For 1, 2, .. rows of a panel, from some of the vectors on.
template <class Number>
struct PanelKernels {
  using Product = void (*)(const FactorPanel<Number>&, const Number* x, Number* const* y, int first, int stride);
  using Transposed = void (*)(const FactorPanel<Number>&, const Number* const* y, Number* x, int first, int stride);
  using Substitution = void (*)(const FactorPanel<Number>&, Number* x, int first, int stride);
  Product product[lines_abreast];
  Transposed transposed[lines_abreast];
  Substitution forwards[lines_abreast], backwards[lines_abreast];
};

/// For 1, 2, .. columns of a tall matrix, from some of the vectors on.
struct TallKernels {
  using InnerProducts = void (*)(const TallColumns&, const double* y, double* x, int first, int stride);
  using Product = void (*)(const TallColumns&, const double* x, double* y, int first, int stride);
  InnerProducts inner_products[lines_abreast];
  Product product[lines_abreast];
};

/// Kernels for a few vectors, and others for as many as registers take.
template <class Of>
struct FewAndMost {
  int of_few, of_most;  // vectors
  Of few, most;
};

/// Calls work(kernels, first) for pieces of the vectors.
template <class Of, class Work>
void for_pieces(const FewAndMost<Of>& kernels, const Vectors& vectors, const Work& work) {
  for (int done = 0; done < vectors.count;) {
    const bool many = vectors.count - done >= kernels.of_most;
    work(many ? kernels.most : kernels.few, vectors.first + done);
    done += many ? kernels.of_most : kernels.of_few;
  }
}

}  // namespace

/// For one kind of processor.
struct FewVectors::Kernels {
  FewAndMost<PanelKernels<double>> panels;
  FewAndMost<PanelKernels<float>> single_panels;
  FewAndMost<TallKernels> tall;

  template <class Number>
  const FewAndMost<PanelKernels<Number>>& panels_of() const {
    if constexpr (std::is_same_v<Number, float>)
      return single_panels;
    else
      return panels;
  }
};

namespace {

// GCC decides how vectors are split where a function is compiled, which is why the same text is compiled for each kind
// of processor.
#define BIELLE_NUMBERS(type, bytes) type __attribute__((vector_size(bytes)))
namespace anywhere {
using Doubles = BIELLE_NUMBERS(double, 16);
using Singles = BIELLE_NUMBERS(float, 16);
using MostSingles = Singles;
constexpr int most_pieces = 1;
#include "reduce/spectral/few_vectors.inc"
}  // namespace anywhere

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BIELLE_KINDS_OF_PROCESSORS
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
using Doubles = BIELLE_NUMBERS(double, 32);
using Singles = BIELLE_NUMBERS(float, 32);
using MostSingles = Singles;
constexpr int most_pieces = 1;
#include "reduce/spectral/few_vectors.inc"
}  // namespace avx2
#pragma GCC target("avx512f,avx512vl,avx2,fma")
namespace avx512 {
using Doubles = BIELLE_NUMBERS(double, 64);
using Singles = BIELLE_NUMBERS(float, 32);
using MostSingles = BIELLE_NUMBERS(float, 64);
constexpr int most_pieces = 2;
#include "reduce/spectral/few_vectors.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif
#undef BIELLE_NUMBERS

}  // namespace

std::vector<const FewVectors*> FewVectors::all() {
  static constexpr FewVectors everywhere(anywhere::kernels);
  std::vector<const FewVectors*> all{&everywhere};
#ifdef BIELLE_KINDS_OF_PROCESSORS
  static constexpr FewVectors with_avx2(avx2::kernels), with_avx512(avx512::kernels);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.push_back(&with_avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) all.push_back(&with_avx512);
#endif
  return all;
}

const FewVectors& FewVectors::fastest() {
  static const FewVectors& kernels = *all().back();
  return kernels;
}

template <class Number>
void FewVectors::subtract_product(const FactorPanel<Number>& panel, const Number* x, Number* const* y,
                                  const Vectors& vectors) const {
  for_pieces(kernels_.panels_of<Number>(), vectors, [&](const PanelKernels<Number>& kernels, int first) {
    kernels.product[panel.rows - 1](panel, x, y, first, vectors.stride);
  });
}

template <class Number>
void FewVectors::subtract_transposed_product(const FactorPanel<Number>& panel, const Number* const* y, Number* x,
                                             const Vectors& vectors) const {
  for_pieces(kernels_.panels_of<Number>(), vectors, [&](const PanelKernels<Number>& kernels, int first) {
    kernels.transposed[panel.rows - 1](panel, y, x, first, vectors.stride);
  });
}

template <class Number>
void FewVectors::substitute_forwards(const FactorPanel<Number>& panel, Number* x, const Vectors& vectors) const {
  for_pieces(kernels_.panels_of<Number>(), vectors, [&](const PanelKernels<Number>& kernels, int first) {
    kernels.forwards[panel.rows - 1](panel, x, first, vectors.stride);
  });
}

template <class Number>
void FewVectors::substitute_backwards(const FactorPanel<Number>& panel, Number* x, const Vectors& vectors) const {
  for_pieces(kernels_.panels_of<Number>(), vectors, [&](const PanelKernels<Number>& kernels, int first) {
    kernels.backwards[panel.rows - 1](panel, x, first, vectors.stride);
  });
}

#define BIELLE_PANELS_OF(Number)                                                                                   \
  template void FewVectors::subtract_product(const FactorPanel<Number>&, const Number*, Number* const*,            \
                                             const Vectors&) const;                                                \
  template void FewVectors::subtract_transposed_product(const FactorPanel<Number>&, const Number* const*, Number*, \
                                                        const Vectors&) const;                                     \
  template void FewVectors::substitute_forwards(const FactorPanel<Number>&, Number*, const Vectors&) const;        \
  template void FewVectors::substitute_backwards(const FactorPanel<Number>&, Number*, const Vectors&) const;
BIELLE_PANELS_OF(double)
BIELLE_PANELS_OF(float)
#undef BIELLE_PANELS_OF

void FewVectors::add_inner_products(const TallColumns& A, const double* y, double* x, const Vectors& vectors) const {
  for_pieces(kernels_.tall, vectors, [&](const TallKernels& kernels, int first) {
    kernels.inner_products[A.columns - 1](A, y, x, first, vectors.stride);
  });
}

void FewVectors::add_product(const TallColumns& A, const double* x, double* y, const Vectors& vectors) const {
  for_pieces(kernels_.tall, vectors, [&](const TallKernels& kernels, int first) {
    kernels.product[A.columns - 1](A, x, y, first, vectors.stride);
  });
}

}  // namespace bielle
