#include "reduce/dense/blas.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <new>
#include <vector>

#include <cblas.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include "reduce/common/process/address_space.hpp"

namespace bielle {

namespace {

/// Returns the width of the vector instructions of a family of OpenBLAS kernels [bits]; 0 if unknown.
int kernel_width(const std::string& core) {
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), core) != names.end();
  };
  if (is_one_of({"SkylakeX", "Cooperlake", "Sapphirerapids"})) {
    return 512;
  }
  if (is_one_of({"Haswell", "Zen", "Excavator", "Steamroller", "Piledriver", "Bulldozer", "Sandybridge"})) {
    return 256;
  }
  if (is_one_of({"Prescott", "Katmai", "Coppermine", "Northwood", "Core2", "Penryn", "Dunnington", "Nehalem", "Atom",
                 "Opteron", "Opteron_SSE3", "Barcelona", "Bobcat", "Nano", "Generic"})) {
    return 128;
  }
  return 0;
}

/// Returns the width of the vector instructions of this processor [bits]; 0 if unknown.
int processor_width() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    return 512;
  }
  return __builtin_cpu_supports("avx2") ? 256 : 128;
#else
  return 0;
#endif
}

/// Address space for the stack and the heap of a thread.
constexpr rlim_t of_thread = rlim_t{80} << 20;

}  // namespace

BlasThreads::BlasThreads(int threads) : before_(openblas_get_num_threads()) { openblas_set_num_threads(threads); }

BlasThreads::~BlasThreads() { openblas_set_num_threads(before_); }

void add_dense_product(const DenseBlock& a, const DenseBlock& b, double* c, Eigen::Index stride) {
  if (a.rows == 0 || a.columns == 0 || b.columns == 0) {
    return;
  }
  const auto integer = [](Eigen::Index k) { return static_cast<int>(k); };
  const auto order = [](const DenseBlock& block) { return block.row_major ? CblasTrans : CblasNoTrans; };
  cblas_dgemm(CblasColMajor, order(a), order(b), integer(a.rows), integer(b.columns), integer(a.columns), 1, a.data,
              integer(a.stride), b.data, integer(b.stride), 1, c, integer(stride));
}

Eigen::MatrixXd dense_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  add_dense_product({a.data(), a.rows(), a.cols(), a.outerStride(), false},
                    {b.data(), b.rows(), b.cols(), b.outerStride(), false}, c.data(), c.rows());
  return c;
}

std::string blas_description() {
  const std::string config = openblas_get_config();  // "OpenBLAS 0.3.21 NO_AFFINITY ..."
  const auto end = config.find(' ', config.find(' ') + 1);
  return fmt::format("{}, kernels for {}", config.substr(0, end), openblas_get_corename());
}

std::string blas_warning() {
  const std::string core = openblas_get_corename();
  const int kernel = kernel_width(core), processor = processor_width();
  if (kernel == 0 || processor == 0 || kernel >= processor) {
    return "";
  }
  const char* forced = std::getenv("OPENBLAS_CORETYPE");
  return fmt::format(
      "OpenBLAS runs its {} kernels ({} bit) on a processor with {}-bit vectors: factorisations may take up to {} "
      "times "
      "as long; {}",
      core, kernel, processor, processor / kernel,
      forced ? fmt::format("unset the environment variable OPENBLAS_CORETYPE ({})", forced)
             : fmt::format("OpenBLAS does not know this processor; set the environment variable OPENBLAS_CORETYPE={}",
                           processor == 512 ? "SkylakeX" : "Haswell"));
}

double measure_dgemm(int size, int threads, int repeats) {
  const BlasThreads limit(threads);
  const std::size_t entries = static_cast<std::size_t>(size) * size;
  std::vector<double> a(entries, 0.5), b(entries, 0.25), c(entries, 0);
  double best = 0;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, size, size, size, 1, a.data(), size, b.data(), size, 0,
                c.data(), size);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::max(best, 2e-9 * size * size * size / seconds);
  }
  return best;
}

void start_blas(int threads) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  const auto count = static_cast<rlim_t>(threads);
  const auto check = [&](rlim_t needed) {
    if (address_space() + needed > limit.rlim_cur) throw std::bad_alloc();
  };
  check(count * blas_buffer);
  measure_dgemm(256, threads, 1);
  check((count - 1) * blas_buffer + count * of_thread);
  // All threads call at the same time: a thread that called after another one had finished would reuse its memory. The
  // calls are repeated, since a thread may start late.
  const BlasThreads one(1);
  for (int time = 0; time < 10; ++time) {
#pragma omp parallel num_threads(threads)
    {
#pragma omp barrier
      measure_dgemm(256, 1, 1);
    }
  }
}

}  // namespace bielle
