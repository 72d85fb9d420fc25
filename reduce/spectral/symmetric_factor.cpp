#include "reduce/spectral/symmetric_factor.hpp"

#include <algorithm>
#include <chrono>
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
#include "reduce/spectral/multifrontal.hpp"
#include "reduce/spectral/numeric_factor.hpp"
#include "reduce/spectral/refined_factor.hpp"

namespace bielle {

namespace {

constexpr double singular_pivot = 1e-14;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double estimated_MB(const FactorStructure& structure, const Multifrontal& elimination, std::size_t number) {
  return 1e-6 * (structure.bytes(number) + static_cast<double>(number) * elimination.working_numbers());
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
  FactorStatistics statistics;
  std::optional<NumericFactor<double>> factor;
  std::optional<RefinedFactor> refined;  // in place of it
  int threads = 1;

  Implementation(const BorderedPart& a, std::shared_ptr<const FactorStructure> structure_of_a, int thread_count,
                 FactorPrecision precision)
      : structure(std::move(structure_of_a)), threads(std::max(1, thread_count)) {
    const std::vector<double> diagonal = a.diagonal();
    for (std::size_t j = 0; j < diagonal.size(); ++j)
      if (!(diagonal[j] > 0)) throw NotPositiveDefinite(static_cast<std::int64_t>(j));
    const auto start = std::chrono::steady_clock::now();
    const Multifrontal elimination(structure->supernodes(), threads);
    statistics.unknowns = a.size();
    statistics.nonzeros = structure->nonzeros();
    statistics.flops = structure->flops();
    statistics.estimated_MB = estimated_MB(*structure, elimination, sizeof(double));
    statistics.is_single = precision == FactorPrecision::single ||
                           (precision == FactorPrecision::automatic && statistics.estimated_MB > free_memory_MB());
    if (statistics.is_single) statistics.estimated_MB = estimated_MB(*structure, elimination, sizeof(float));
    statistics.ordering_seconds = structure->ordering_seconds();
    refuse_what_does_not_fit(statistics.estimated_MB, a.size());
    statistics.analysis_seconds = structure->analysis_seconds() + seconds_since(start);
    const auto numbers = std::chrono::steady_clock::now();
    try {
      if (statistics.is_single)
        refined.emplace(*structure, elimination, a, threads);
      else
        factor.emplace(*structure, elimination, a, std::span<const double>(), diagonal, threads);
    } catch (const std::bad_alloc&) {
      throw ComputationError(
          "not enough memory for the factorisation of the stiffness matrix; a coarser mesh needs less");
    }
    statistics.factorisation_seconds = seconds_since(numbers);
    const Pivots& pivots = refined ? refined->pivots() : factor->pivots();
    if (!(pivots.relative > singular_pivot)) throw NotPositiveDefinite(pivots.unknown);
    statistics.reciprocal_condition = pivots.least_over_largest;
  }
};

SymmetricFactor::SymmetricFactor(const BorderedPart& a, std::shared_ptr<const FactorStructure> structure, int threads,
                                 FactorPrecision precision)
    : implementation_(std::make_unique<Implementation>(a, std::move(structure), threads, precision)) {}

SymmetricFactor::SymmetricFactor(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts, int threads) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(a.size));
  std::iota(all.begin(), all.end(), 0);
  implementation_ = std::make_unique<Implementation>(
      BorderedPart{a, all, {}, {}}, std::make_shared<const FactorStructure>(block_graph(a, block_starts)), threads,
      FactorPrecision::full);
}

SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;
SymmetricFactor::~SymmetricFactor() = default;

std::int64_t SymmetricFactor::size() const { return implementation_->statistics.unknowns; }

const FactorStatistics& SymmetricFactor::statistics() const { return implementation_->statistics; }

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& b) const {
  if (b.size() == 0) return b;
  return implementation_->refined ? implementation_->refined->solve(b) : implementation_->factor->solve(b);
}

Eigen::MatrixXd SymmetricFactor::precondition(const Eigen::MatrixXd& b) const {
  if (b.size() == 0 || !implementation_->refined) return solve(b);
  return implementation_->refined->precondition(b);
}

PivotSigns SymmetricFactor::count_signs(SymmetricMatrix a, const std::vector<double>& scale) const {
  try {
    const BorderedStructure bordered(implementation_->structure->supernodes(), a.size - size());
    return Multifrontal(bordered.structure(), implementation_->threads).count_signs(std::move(a), scale);
  } catch (const std::bad_alloc&) {
    throw ComputationError("not enough memory to count the signs of a matrix; leave the proof out");
  }
}

}  // namespace bielle
