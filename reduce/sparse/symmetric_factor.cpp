#include "reduce/sparse/symmetric_factor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <omp.h>

#include "reduce/common/process/free_memory.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/sparse/block_graph.hpp"

namespace bielle {

namespace {

/// Products of smaller factors are short, and CHOLMOD computes them one after the other, so that a second BLAS thread
/// mostly waits. On a busy machine two threads took 3.5 times as long as one at 1.8e10.
constexpr double worth_threads = 1e11;  // operations
constexpr const char* of_numbers = "the factorisation of the stiffness matrix";

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The squares of the diagonal of L.
struct Pivots {
  std::int64_t unknown = -1;  ///< unknown of the smallest pivot relative to the diagonal of A
  double relative = 1;        ///< its ratio
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
};

Pivots find_pivots(const cholmod_factor& factor, const Eigen::VectorXd& diagonal) {
  const auto* columns = static_cast<const std::int64_t*>(factor.super);
  const auto* row_starts = static_cast<const std::int64_t*>(factor.pi);
  const auto* value_starts = static_cast<const std::int64_t*>(factor.px);
  const auto* values = static_cast<const double*>(factor.x);
  const auto* order = static_cast<const std::int64_t*>(factor.Perm);
  Pivots result;
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const std::int64_t rows = row_starts[s + 1] - row_starts[s];
    for (std::int64_t k = 0; k < columns[s + 1] - columns[s]; ++k) {
      const std::int64_t unknown = order[columns[s] + k];
      const double root = values[value_starts[s] + k * (rows + 1)], pivot = root * root;
      result.smallest = std::min(result.smallest, pivot);
      result.largest = std::max(result.largest, pivot);
      const double relative = pivot / diagonal(unknown);
      if (std::isnan(relative)) return {unknown, relative, pivot, pivot};
      if (relative < result.relative) {
        result.unknown = unknown;
        result.relative = relative;
      }
    }
  }
  return result;
}

/// Refuses a factorisation that does not fit in memory: otherwise the machine would run out of memory minutes later, or
/// end the process without a message.
void refuse_what_does_not_fit(double estimate, std::int64_t unknowns) {
  const double free = free_memory_MB();
  if (estimate <= free) return;
  throw ComputationError(fmt::format(
      "the factorised stiffness matrix of {} unknowns needs about {:.0f} MB, but only {:.0f} MB of memory are "
      "free; take a coarser mesh, end other programs, or raise the limit (ulimit -v)",
      unknowns, estimate, free));
}

/// Prevents CHOLMOD from running some loops in four threads, whatever the number of processors; BLAS has its own
/// threads.
class NoThreadsOfCholmod {
 public:
  NoThreadsOfCholmod() : before_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~NoThreadsOfCholmod() { omp_set_max_active_levels(before_); }
  NoThreadsOfCholmod(const NoThreadsOfCholmod&) = delete;
  NoThreadsOfCholmod& operator=(const NoThreadsOfCholmod&) = delete;

 private:
  int before_;
};

/// A thread's working memory for solutions.
class Solver {
 public:
  Solver() = default;
  ~Solver() {
    cholmod_l_free_dense(&work_, workspace_.get());
    cholmod_l_free_dense(&more_work_, workspace_.get());
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  /// Computes some columns of X from those of B.
  void solve(cholmod_factor* factor, const Eigen::MatrixXd& b, Eigen::MatrixXd& x, Eigen::Index first,
             Eigen::Index count) {
    cholmod_dense right = view(const_cast<double*>(b.col(first).data()), b.rows(), count);
    cholmod_dense solution = view(x.col(first).data(), x.rows(), count), *place = &solution;
    cholmod_l_solve2(CHOLMOD_A, factor, &right, nullptr, &place, nullptr, &work_, &more_work_, workspace_.get());
  }
  void check() const { workspace_.check("a solution with the factorised stiffness matrix"); }

 private:
  static cholmod_dense view(double* numbers, Eigen::Index rows, Eigen::Index columns) {
    cholmod_dense result{};
    result.nrow = result.d = static_cast<std::size_t>(rows);
    result.ncol = static_cast<std::size_t>(columns);
    result.nzmax = result.nrow * result.ncol;
    result.x = numbers;
    result.xtype = CHOLMOD_REAL;
    result.dtype = CHOLMOD_DOUBLE;
    return result;
  }

  CholmodWorkspace workspace_;
  cholmod_dense *work_ = nullptr, *more_work_ = nullptr;
};

}  // namespace

struct SymmetricFactor::Implementation {
  std::shared_ptr<const FactorStructure> structure;
  CholmodWorkspace workspace;
  CholmodFactor factor;
  FactorStatistics statistics;
  int threads = 1;
  mutable std::mutex guard;
  mutable std::vector<Solver> solvers;

  Implementation(std::shared_ptr<const FactorStructure> structure_of_a, SymmetricMatrix a, int thread_count)
      : structure(std::move(structure_of_a)),
        threads(std::max(1, thread_count)),
        solvers(static_cast<std::size_t>(threads)) {
    const Eigen::VectorXd diagonal = a.diagonal();
    for (Eigen::Index j = 0; j < diagonal.size(); ++j)
      if (!(diagonal(j) > 0)) throw NotPositiveDefinite(j);
    statistics.unknowns = a.size;
    statistics.nonzeros = structure->nonzeros();
    statistics.flops = structure->flops();
    statistics.estimated_MB = 1e-6 * structure->bytes();
    statistics.ordering_seconds = structure->ordering_seconds();
    statistics.analysis_seconds = structure->analysis_seconds();
    refuse_what_does_not_fit(statistics.estimated_MB, a.size);
    const auto start = std::chrono::steady_clock::now();
    factorise(std::move(a));
    statistics.factorisation_seconds = seconds_since(start);
    const Pivots pivots = find_pivots(*factor, diagonal);
    if (!(pivots.relative > singular_pivot)) throw NotPositiveDefinite(pivots.unknown);
    statistics.reciprocal_condition = pivots.smallest / pivots.largest;
  }

  void factorise(SymmetricMatrix a) {
    const CholmodSparse lower = in_order(std::move(a));
    factor = {cholmod_l_copy_factor(const_cast<cholmod_factor*>(&structure->symbolic()), workspace.get()),
              {workspace.get()}};
    workspace.check(of_numbers);
    const BlasThreads blas(structure->flops() < worth_threads ? 1 : threads);
    const NoThreadsOfCholmod none;
    double nothing_added[2] = {0, 0};
    cholmod_l_super_numeric(lower.get(), nullptr, nothing_added, factor.get(), workspace.get());
    workspace.check(of_numbers);
    if (workspace->status == CHOLMOD_NOT_POSDEF)
      throw NotPositiveDefinite(static_cast<const std::int64_t*>(factor->Perm)[factor->minor]);
  }

  /// Returns the lower triangle of P A P^T.
  CholmodSparse in_order(SymmetricMatrix a) {
    cholmod_sparse view = cholmod_view(a);
    auto* order = const_cast<std::int64_t*>(structure->order().data());
    const CholmodSparse upper{cholmod_l_ptranspose(&view, 1, order, nullptr, 0, workspace.get()), {workspace.get()}};
    workspace.check(of_numbers);
    a = {};
    CholmodSparse lower{cholmod_l_transpose(upper.get(), 1, workspace.get()), {workspace.get()}};
    workspace.check(of_numbers);
    return lower;
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const {
    const std::lock_guard lock(guard);  // protects the working memory
    Eigen::MatrixXd x(b.rows(), b.cols());
    constexpr Eigen::Index most = 16;  // columns of a thread at a time: working memory stays small
    const auto sharing = std::min<Eigen::Index>(threads, b.cols());
    const Eigen::Index parts = (b.cols() + most * sharing - 1) / (most * sharing) * sharing;
    const BlasThreads one(1);  // a second one gains little where memory is the limit, and spins while it waits
#pragma omp parallel for num_threads(static_cast <int>(sharing)) schedule(static, 1)
    for (Eigen::Index part = 0; part < parts; ++part) {
      const Eigen::Index first = b.cols() * part / parts, count = b.cols() * (part + 1) / parts - first;
      if (count > 0) solvers[static_cast<std::size_t>(omp_get_thread_num())].solve(factor.get(), b, x, first, count);
    }
    for (const Solver& solver : solvers) solver.check();
    return x;
  }
};

SymmetricFactor::SymmetricFactor(std::shared_ptr<const FactorStructure> structure, SymmetricMatrix a, int threads)
    : implementation_(std::make_unique<Implementation>(std::move(structure), std::move(a), threads)) {}

SymmetricFactor::SymmetricFactor(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts, int threads)
    : SymmetricFactor(std::make_shared<const FactorStructure>(block_graph(a, block_starts)), a, threads) {}

SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;
SymmetricFactor::~SymmetricFactor() = default;

const FactorStatistics& SymmetricFactor::statistics() const { return implementation_->statistics; }

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& b) const {
  if (b.size() == 0) return b;
  return implementation_->solve(b);
}

std::optional<PivotSigns> SymmetricFactor::count_signs(const SymmetricMatrix& a,
                                                       const std::vector<double>& scale) const {
  const std::span<const std::int64_t> inner = implementation_->structure->order();
  std::vector<std::int64_t> order(inner.begin(), inner.end());
  for (std::int64_t k = size(); k < a.size; ++k) order.push_back(k);
  return pivot_signs(a, order, scale);
}

}  // namespace bielle
