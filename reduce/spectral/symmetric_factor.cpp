#include "reduce/spectral/symmetric_factor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/free_memory.hpp"
#include "reduce/spectral/block_graph.hpp"
#include "reduce/spectral/bordered_structure.hpp"
#include "reduce/spectral/huge_pages.hpp"
#include "reduce/spectral/multifrontal.hpp"
#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

namespace {

constexpr double singular_pivot = 1e-14;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The squares of the diagonal of L.
struct Pivots {
  std::int64_t unknown = -1;  ///< of the smallest relative to the diagonal of A
  double relative = 1;        ///< how small
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
};

Pivots find_pivots(const SupernodalFactor& factor, const std::vector<double>& diagonal) {
  Pivots result;
  for (std::int64_t s = 0; s < factor.supernodes; ++s) {
    const std::int64_t rows = factor.row_starts[s + 1] - factor.row_starts[s];
    for (std::int64_t k = 0; k < factor.columns[s + 1] - factor.columns[s]; ++k) {
      const std::int64_t unknown = factor.order[factor.columns[s] + k];
      const double root = factor.values[factor.value_starts[s] + k * (rows + 1)], pivot = root * root;
      result.smallest = std::min(result.smallest, pivot);
      result.largest = std::max(result.largest, pivot);
      const double relative = pivot / diagonal[static_cast<std::size_t>(unknown)];
      if (std::isnan(relative)) return {unknown, relative, pivot, pivot};
      if (relative < result.relative) {
        result.unknown = unknown;
        result.relative = relative;
      }
    }
  }
  return result;
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
  std::shared_ptr<const FactorStructure> structure;
  SupernodalFactor factor;
  ZeroNumbers values;
  FactorStatistics statistics;
  std::optional<SupernodalSolver> solver;
  int threads = 1;

  Implementation(const BorderedPart& a, std::shared_ptr<const FactorStructure> structure_of_a, int thread_count)
      : structure(std::move(structure_of_a)), factor(structure->supernodes()), threads(std::max(1, thread_count)) {
    const std::vector<double> diagonal = a.diagonal();
    for (std::size_t j = 0; j < diagonal.size(); ++j)
      if (!(diagonal[j] > 0)) throw NotPositiveDefinite(static_cast<std::int64_t>(j));
    const auto start = std::chrono::steady_clock::now();
    const Multifrontal elimination(structure->supernodes(), threads);
    statistics.unknowns = a.size();
    statistics.nonzeros = structure->nonzeros();
    statistics.flops = structure->flops();
    statistics.estimated_MB = 1e-6 * (structure->bytes() + elimination.working_bytes());
    statistics.ordering_seconds = structure->ordering_seconds();
    refuse_what_does_not_fit(statistics.estimated_MB, a.size());
    statistics.analysis_seconds = structure->analysis_seconds() + seconds_since(start);
    factorise(elimination, a);
    const Pivots pivots = find_pivots(factor, diagonal);
    if (!(pivots.relative > singular_pivot)) throw NotPositiveDefinite(pivots.unknown);
    statistics.reciprocal_condition = pivots.smallest / pivots.largest;
    solver.emplace(factor, values.get(), threads);
  }

  void factorise(const Multifrontal& elimination, const BorderedPart& a) {
    const auto start = std::chrono::steady_clock::now();
    std::optional<std::int64_t> failed;
    try {
      values = ZeroNumbers(static_cast<std::size_t>(structure->values()));
      failed = elimination.factorise(a, values.get());
    } catch (const std::bad_alloc&) {
      throw ComputationError(
          "not enough memory for the factorisation of the stiffness matrix; a coarser mesh needs less");
    }
    if (failed) throw NotPositiveDefinite(factor.order[*failed]);
    factor.values = values.get();
    statistics.factorisation_seconds = seconds_since(start);
  }
};

SymmetricFactor::SymmetricFactor(const BorderedPart& a, std::shared_ptr<const FactorStructure> structure, int threads)
    : implementation_(std::make_unique<Implementation>(a, std::move(structure), threads)) {}

SymmetricFactor::SymmetricFactor(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts, int threads) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(a.size));
  std::iota(all.begin(), all.end(), 0);
  implementation_ = std::make_unique<Implementation>(
      BorderedPart{a, all, {}, {}}, std::make_shared<const FactorStructure>(block_graph(a, block_starts)), threads);
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
    const BorderedStructure bordered(implementation_->factor, a.size - size());
    return Multifrontal(bordered.structure(), implementation_->threads).count_signs(std::move(a), scale);
  } catch (const std::bad_alloc&) {
    throw ComputationError("not enough memory to count the signs of a matrix; leave the proof out");
  }
}

}  // namespace bielle
