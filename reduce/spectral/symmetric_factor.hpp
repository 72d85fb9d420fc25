// Cholesky factorisation of large sparse symmetric positive definite matrices, L L^T in supernodes:
// factor_structure.hpp finds their structure, multifrontal.hpp the numbers.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/error.hpp"
#include "reduce/spectral/bordered_part.hpp"
#include "reduce/spectral/factor_structure.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"

namespace bielle {

/// What a factorisation cost.
struct FactorStatistics {
  std::int64_t unknowns = 0;
  std::int64_t nonzeros = 0;  ///< of L
  double flops = 0;
  double estimated_MB = 0;  ///< of memory for the factorisation, known before it starts [1e6 bytes]
  double ordering_seconds = 0, analysis_seconds = 0, factorisation_seconds = 0;  ///< wall time
  double reciprocal_condition = 0;  ///< rough: (smallest / largest diagonal entry of L)^2

  double speed() const { return 1e-9 * flops / factorisation_seconds; }  ///< [GFLOP/s]
  double memory_MB() const { return 8e-6 * static_cast<double>(nonzeros); }
  double seconds() const { return ordering_seconds + analysis_seconds + factorisation_seconds; }
};

/// The matrix is singular or indefinite: the caller knows what the unknown means to the user.
class NotPositiveDefinite : public ComputationError {
 public:
  explicit NotPositiveDefinite(std::int64_t unknown);
  std::int64_t unknown() const { return unknown_; }  ///< where the elimination met a pivot that is not positive

 private:
  std::int64_t unknown_;
};

/// Signs of the pivots of L D L^T.
struct PivotSigns {
  std::int64_t negative = 0;
  /// Largest L_ij^2 |D_jj| over the scale of i. At the most 1 where A is definite and scaled by its diagonal; rounding
  /// errors are as many times those of a Cholesky factorisation.
  double growth = 0;
};

/// P A P^T = L L^T, and solutions with it.
class SymmetricFactor {
 public:
  /// @param a             positive definite
  /// @param block_starts  first unknown of each block, then `a.size`; empty: every unknown is its own block
  /// @param threads       >= 1, for the factorisation and for solutions
  /// @throws NotPositiveDefinite also when a pivot is so small (1e-14 of its diagonal entry) that A is singular to
  ///         working precision; ComputationError when memory does not suffice, as far as the
  ///         symbolic factorisation tells before the numerical one starts
  explicit SymmetricFactor(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts = {}, int threads = 1);
  /// @param a          positive definite
  /// @param structure  made for its pattern, or one that holds it
  SymmetricFactor(const BorderedPart& a, std::shared_ptr<const FactorStructure> structure, int threads);
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;
  ~SymmetricFactor();

  std::int64_t size() const;
  const FactorStatistics& statistics() const;

  /// A^-1 b for a block of right-hand sides (size,k). Solutions are bound by memory: many columns cost little more than
  /// one, so ask for all at once.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

  /// How many eigenvalues of another symmetric matrix, not necessarily definite, are negative: the signs of the pivots
  /// of its L D L^T in the same order. What it takes is another factorisation; its L is not kept.
  /// @param a      the pattern of that which was factorised, or part of it; then any number of unknowns more. Growth is
  ///               infinite where the pattern has more
  /// @param scale  of each unknown, the size of its diagonal entry: growth is measured by it
  /// @throws ComputationError when memory does not suffice
  PivotSigns count_signs(SymmetricMatrix a, const std::vector<double>& scale) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bielle
