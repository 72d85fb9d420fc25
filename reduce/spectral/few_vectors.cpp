#include "reduce/spectral/few_vectors.hpp"

#include <utility>

namespace bielle {

namespace {

/// For 1, 2, .. rows of a panel or columns of a tall matrix, from some of the vectors on.
struct KernelsOfLines {
  using Product = void (*)(const FactorPanel&, const double* x, double* const* y, int first, int stride);
  using Transposed = void (*)(const FactorPanel&, const double* const* y, double* x, int first, int stride);
  using Substitution = void (*)(const FactorPanel&, double* x, int first, int stride);
  using InnerProducts = void (*)(const TallColumns&, const double* y, double* x, int first, int stride);
  using TallProduct = void (*)(const TallColumns&, const double* x, double* y, int first, int stride);
  Product product[lines_abreast];
  Transposed transposed[lines_abreast];
  Substitution forwards[lines_abreast], backwards[lines_abreast];
  InnerProducts inner_products[lines_abreast];
  TallProduct tall_product[lines_abreast];
};

}  // namespace

/// For one kind of processor, with one or with most registers of `width` vectors each.
struct FewVectors::Kernels {
  int width, most_pieces;
  KernelsOfLines one, most;
};

namespace {

// GCC decides how vectors are split where a function is compiled, which is why the same text is compiled for each kind
// of processor. What stands in memory may begin anywhere.
namespace anywhere {
using Vector = double __attribute__((vector_size(16), aligned(sizeof(double)), may_alias));
constexpr int most_pieces = 1;
#include "reduce/spectral/few_vectors.inc"
}  // namespace anywhere

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BIELLE_KINDS_OF_PROCESSORS
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
using Vector = double __attribute__((vector_size(32), aligned(sizeof(double)), may_alias));
constexpr int most_pieces = 1;
#include "reduce/spectral/few_vectors.inc"
}  // namespace avx2
#pragma GCC target("avx512f,avx512vl,avx2,fma")
namespace avx512 {
using Vector = double __attribute__((vector_size(64), aligned(sizeof(double)), may_alias));
constexpr int most_pieces = 2;
#include "reduce/spectral/few_vectors.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

/// Calls work(kernels, first) for pieces of the vectors.
template <class Work>
void for_pieces(const FewVectors::Kernels& kernels, const Vectors& vectors, const Work& work) {
  for (int done = 0; done < vectors.count;) {
    const bool many = vectors.count - done >= kernels.width * kernels.most_pieces;
    work(many ? kernels.most : kernels.one, vectors.first + done);
    done += kernels.width * (many ? kernels.most_pieces : 1);
  }
}

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

void FewVectors::subtract_product(const FactorPanel& panel, const double* x, double* const* y,
                                  const Vectors& vectors) const {
  for_pieces(kernels_, vectors, [&](const KernelsOfLines& kernels, int first) {
    kernels.product[panel.rows - 1](panel, x, y, first, vectors.stride);
  });
}

void FewVectors::subtract_transposed_product(const FactorPanel& panel, const double* const* y, double* x,
                                             const Vectors& vectors) const {
  for_pieces(kernels_, vectors, [&](const KernelsOfLines& kernels, int first) {
    kernels.transposed[panel.rows - 1](panel, y, x, first, vectors.stride);
  });
}

void FewVectors::substitute_forwards(const FactorPanel& panel, double* x, const Vectors& vectors) const {
  for_pieces(kernels_, vectors, [&](const KernelsOfLines& kernels, int first) {
    kernels.forwards[panel.rows - 1](panel, x, first, vectors.stride);
  });
}

void FewVectors::substitute_backwards(const FactorPanel& panel, double* x, const Vectors& vectors) const {
  for_pieces(kernels_, vectors, [&](const KernelsOfLines& kernels, int first) {
    kernels.backwards[panel.rows - 1](panel, x, first, vectors.stride);
  });
}

void FewVectors::add_inner_products(const TallColumns& A, const double* y, double* x, const Vectors& vectors) const {
  for_pieces(kernels_, vectors, [&](const KernelsOfLines& kernels, int first) {
    kernels.inner_products[A.columns - 1](A, y, x, first, vectors.stride);
  });
}

void FewVectors::add_product(const TallColumns& A, const double* x, double* y, const Vectors& vectors) const {
  for_pieces(kernels_, vectors, [&](const KernelsOfLines& kernels, int first) {
    kernels.tall_product[A.columns - 1](A, x, y, first, vectors.stride);
  });
}

}  // namespace bielle
