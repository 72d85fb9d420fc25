// Cholesky factorisation of large sparse symmetric positive definite matrices by CHOLMOD, L L^T in supernodes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "reduce/sparse/factor.hpp"
#include "reduce/sparse/factor_structure.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle {

/// P A P^T = L L^T, and solutions with it.
class SymmetricFactor : public Factor {
 public:
  /// @param a             positive definite
  /// @param block_starts  first unknown of each block, then `a.size`; if empty, every unknown is its own block
  /// @param threads       >= 1, for the factorisation and for solutions
  /// @throws NotPositiveDefinite also if a pivot is so small (`singular_pivot`) that A is singular to working
  ///         precision; ComputationError if memory does not suffice, as far as the symbolic factorisation predicts
  ///         before the numerical one
  explicit SymmetricFactor(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts = {}, int threads = 1);
  /// @param structure  made for the pattern of a, or for one that contains it
  /// @param a          released as soon as CHOLMOD has a reordered copy
  SymmetricFactor(std::shared_ptr<const FactorStructure> structure, SymmetricMatrix a, int threads);
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;
  ~SymmetricFactor() override;

  const FactorStatistics& statistics() const override;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const override;
  std::optional<PivotSigns> count_signs(const SymmetricMatrix& a, const std::vector<double>& scale) const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bielle
