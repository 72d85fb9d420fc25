#include "reduce/spectral/symmetric_factor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <SuiteSparse_config.h>
#include <cholmod.h>
#include <fmt/format.h>
#include <omp.h>

#include "reduce/common/free_memory.hpp"
#include "reduce/spectral/blas.hpp"
#include "reduce/spectral/bordered_structure.hpp"
#include "reduce/spectral/huge_pages.hpp"
#include "reduce/spectral/memory_warming.hpp"
#include "reduce/spectral/multifrontal.hpp"
#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

namespace {

using Long = SuiteSparse_long;
static_assert(sizeof(Long) == sizeof(std::int64_t));

constexpr double singular_pivot = 1e-14;
constexpr std::int64_t small_graph = 200;  // blocks below which minimum degree orders as well as nested dissection

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// CHOLMOD's settings and workspace; one per thread.
class Common {
 public:
  Common() {
    [[maybe_unused]] static const bool once = [] {
      SuiteSparse_config.malloc_func = allocate_in_huge_pages;
      return true;
    }();
    cholmod_l_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    common_.quick_return_if_not_posdef = 1;
  }
  ~Common() { cholmod_l_finish(&common_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  operator cholmod_common*() { return &common_; }
  cholmod_common* operator->() { return &common_; }

  /// @throws ComputationError when the last call ran out of memory or failed in another way than a bad pivot
  void check(const char* what) const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE) {
      throw ComputationError(
          fmt::format("not enough memory for the {} of the stiffness matrix; a coarser mesh needs less", what));
    }
    if (common_.status < 0) {
      throw ComputationError(fmt::format("CHOLMOD failed in the {} of a matrix (status {})", what, common_.status));
    }
  }

 private:
  cholmod_common common_;
};

/// CHOLMOD's loops ask for OpenMP threads in addition to those of OpenBLAS; together they compete for the cores. While
/// this lives they get none.
class NoOpenMpThreads {
 public:
  NoOpenMpThreads() : before_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~NoOpenMpThreads() { omp_set_max_active_levels(before_); }
  NoOpenMpThreads(const NoOpenMpThreads&) = delete;
  NoOpenMpThreads& operator=(const NoOpenMpThreads&) = delete;

 private:
  int before_;
};

/// A view of a lower triangle for CHOLMOD, which does not change it.
cholmod_sparse view(std::int64_t size, const std::vector<std::int64_t>& starts, const std::vector<std::int64_t>& rows,
                    const double* values) {
  cholmod_sparse a{};
  a.nrow = a.ncol = size;
  a.nzmax = rows.size();
  a.p = const_cast<std::int64_t*>(starts.data());
  a.i = const_cast<std::int64_t*>(rows.data());
  a.x = const_cast<double*>(values);
  a.stype = -1;
  a.itype = CHOLMOD_LONG;
  a.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

struct Graph {
  std::vector<std::int64_t> starts{0}, rows;
};

/// Which blocks of A are coupled, lower triangle.
Graph block_graph(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts) {
  const std::int64_t blocks = static_cast<std::int64_t>(block_starts.size()) - 1;
  std::vector<std::int64_t> block_of(a.size);
  for (std::int64_t b = 0; b < blocks; ++b) {
    std::fill(block_of.begin() + block_starts[b], block_of.begin() + block_starts[b + 1], b);
  }
  Graph graph;
  std::vector<std::int64_t> seen_by(blocks, -1);
  for (std::int64_t b = 0; b < blocks; ++b) {
    const auto first = static_cast<std::ptrdiff_t>(graph.rows.size());
    for (std::int64_t p = a.starts[block_starts[b]]; p < a.starts[block_starts[b + 1]]; ++p) {
      if (const std::int64_t i = block_of[a.rows[p]]; seen_by[i] != b) {
        seen_by[i] = b;
        graph.rows.push_back(i);
      }
    }
    std::sort(graph.rows.begin() + first, graph.rows.end());
    graph.starts.push_back(static_cast<std::int64_t>(graph.rows.size()));
  }
  return graph;
}

/// Order in which to eliminate the unknowns.
std::vector<std::int64_t> fill_reducing_order(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts,
                                              Common& common) {
  const std::int64_t blocks = static_cast<std::int64_t>(block_starts.size()) - 1;
  const Graph graph = block_graph(a, block_starts);
  cholmod_sparse pattern = view(blocks, graph.starts, graph.rows, nullptr);
  std::vector<std::int64_t> order(blocks);
  if (blocks < small_graph) {
    cholmod_l_amd(&pattern, nullptr, 0, order.data(), common);
  } else {
    cholmod_l_metis(&pattern, nullptr, 0, 1, order.data(), common);
  }
  common.check("ordering");
  std::vector<std::int64_t> expanded;
  expanded.reserve(a.size);
  for (const std::int64_t b : order) {
    for (std::int64_t i = block_starts[b]; i < block_starts[b + 1]; ++i) {
      expanded.push_back(i);
    }
  }
  return expanded;
}

/// Squared diagonal of L over the diagonal of A, smallest: where, and how small.
std::pair<std::int64_t, double> smallest_pivot(const cholmod_factor& factor, const SymmetricMatrix& a) {
  const auto* super = static_cast<const Long*>(factor.super);
  const auto* row_starts = static_cast<const Long*>(factor.pi);
  const auto* value_starts = static_cast<const Long*>(factor.px);
  const auto* order = static_cast<const Long*>(factor.Perm);
  const auto* values = static_cast<const double*>(factor.x);
  std::pair<std::int64_t, double> smallest{-1, 1};
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const Long rows = row_starts[s + 1] - row_starts[s];
    for (Long k = 0; k < super[s + 1] - super[s]; ++k) {
      const std::int64_t unknown = order[super[s] + k];
      const double pivot = values[value_starts[s] + k * (rows + 1)];
      const double relative = pivot * pivot / a.values[a.starts[unknown]];
      if (!(relative >= smallest.second)) {
        smallest = {unknown, relative};
      }
    }
  }
  return smallest;
}

/// What CHOLMOD allocates for the values of L, padded supernodes and all, and its row indices [MB].
double estimated_memory(const cholmod_factor& factor) {
  return 8e-6 * (static_cast<double>(factor.xsize) + static_cast<double>(factor.ssize));
}

/// What the factor of a solid of ordinary shape takes with its working memory: nested dissection of a body leaves
/// O(n^4/3) numbers.
std::size_t expected_bytes(std::int64_t unknowns) {
  return static_cast<std::size_t>(100 * std::pow(static_cast<double>(unknowns), 4.0 / 3));
}

/// The machine would otherwise run out of memory minutes later, or end the process without a word.
void refuse_what_does_not_fit(double estimate, std::int64_t unknowns) {
  const double free = free_memory_MB();
  if (estimate <= free) return;
  throw ComputationError(fmt::format(
      "the factorised stiffness matrix of {} unknowns needs about {:.0f} MB, but only {:.0f} MB of memory are "
      "free; take a coarser mesh, end other programs, or raise the limit (ulimit -v)",
      unknowns, estimate, free));
}

}  // namespace

NotPositiveDefinite::NotPositiveDefinite(std::int64_t unknown)
    : ComputationError(fmt::format("the matrix is not positive definite at unknown {}", unknown)), unknown_(unknown) {}

struct SymmetricFactor::Implementation {
  Common common;
  cholmod_factor* factor = nullptr;
  FactorStatistics statistics;
  SupernodalFactor structure;
  std::optional<Multifrontal> elimination;
  std::optional<SupernodalSolver> solver;
  int threads = 1;

  ~Implementation() { cholmod_l_free_factor(&factor, common); }

  /// The structure of L.
  void analyse(const SymmetricMatrix& a, std::vector<std::int64_t>& order) {
    const NoOpenMpThreads no_openmp;
    const BlasThreads one(1);
    cholmod_sparse matrix = view(a.size, a.starts, a.rows, a.values.data());
    factor = cholmod_l_analyze_p(&matrix, order.data(), nullptr, 0, common);
    common.check("analysis");
    const auto integers = [](const void* array) { return static_cast<const std::int64_t*>(array); };
    structure = {a.size,
                 static_cast<std::int64_t>(factor->nsuper),
                 integers(factor->super),
                 integers(factor->pi),
                 integers(factor->px),
                 integers(factor->s),
                 integers(factor->Perm)};
    elimination.emplace(structure, threads);
    statistics.unknowns = a.size;
    statistics.flops = common->fl;
    statistics.nonzeros = static_cast<std::int64_t>(common->lnz);
    statistics.estimated_MB = estimated_memory(*factor) + 1e-6 * elimination->working_bytes();
  }
  /// @returns the column of L where a pivot was not positive; nothing when all were
  std::optional<std::int64_t> factorise(const SymmetricMatrix& a) {
    cholmod_l_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor, common);  // takes memory for the values
    common.check("factorisation");
    try {
      return elimination->factorise(a, static_cast<double*>(factor->x));
    } catch (const std::bad_alloc&) {
      common->status = CHOLMOD_OUT_OF_MEMORY;
      common.check("factorisation");
      throw;
    }
  }
};

SymmetricFactor::SymmetricFactor(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts, int threads)
    : implementation_(std::make_unique<Implementation>()) {
  Common& common = implementation_->common;
  FactorStatistics& statistics = implementation_->statistics;
  cholmod_factor*& factor = implementation_->factor;
  implementation_->threads = std::max(1, threads);
  std::vector<std::int64_t> single;
  if (block_starts.empty()) {
    single.resize(a.size + 1);
    std::iota(single.begin(), single.end(), 0);
    block_starts = single;
  }
  for (std::int64_t j = 0; j < a.size; ++j) {
    if (!(a.values[a.starts[j]] > 0)) {
      throw NotPositiveDefinite(j);
    }
  }

  {
    const MemoryWarming warming(threads > 1 ? expected_bytes(a.size) : 0);  // one thread orders, the others would wait
    auto start = std::chrono::steady_clock::now();
    std::vector<std::int64_t> order = fill_reducing_order(a, block_starts, common);
    statistics.ordering_seconds = seconds_since(start);

    start = std::chrono::steady_clock::now();
    implementation_->analyse(a, order);
    statistics.analysis_seconds = seconds_since(start);
  }
  refuse_what_does_not_fit(statistics.estimated_MB, a.size);

  const auto start = std::chrono::steady_clock::now();
  const std::optional<std::int64_t> failed = implementation_->factorise(a);
  statistics.factorisation_seconds = seconds_since(start);
  if (failed) throw NotPositiveDefinite(implementation_->structure.order[*failed]);
  if (const auto [unknown, pivot] = smallest_pivot(*factor, a); !(pivot > singular_pivot)) {
    throw NotPositiveDefinite(unknown);
  }
  statistics.reciprocal_condition = cholmod_l_rcond(factor, common);
  implementation_->solver.emplace(implementation_->structure, static_cast<double*>(factor->x),
                                  implementation_->threads);
}

SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;
SymmetricFactor::~SymmetricFactor() = default;

std::int64_t SymmetricFactor::size() const { return implementation_->statistics.unknowns; }

const FactorStatistics& SymmetricFactor::statistics() const { return implementation_->statistics; }

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& b) const {
  if (b.size() == 0) return b;
  return implementation_->solver->solve(b);
}

PivotSigns SymmetricFactor::count_signs(SymmetricMatrix a, const std::vector<double>& scale) const {
  try {
    const BorderedStructure bordered(implementation_->structure, a.size - size());
    return Multifrontal(bordered.structure(), implementation_->threads).count_signs(std::move(a), scale);
  } catch (const std::bad_alloc&) {
    throw ComputationError("not enough memory to count the signs of a matrix; leave the proof out");
  }
}

}  // namespace bielle
