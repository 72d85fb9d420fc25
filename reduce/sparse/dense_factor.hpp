// The factor of a small symmetric positive definite matrix, stored densely (LAPACK).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/sparse/factor.hpp"

namespace bielle {

/// Matrices of at most this size are factorised densely: a factorisation with 200 solutions then takes less time than
/// with CHOLMOD (tests/performance/reduce_small_factors).
constexpr std::int64_t most_dense_unknowns = 200;

/// A = L L^T. Several threads may request solutions at the same time; each is computed by one thread.
class DenseFactor : public Factor {
 public:
  /// @param a  positive definite; memory grows with the square of its size
  /// @throws NotPositiveDefinite also if a pivot is so small (`singular_pivot`) that A is singular to working precision
  explicit DenseFactor(const SymmetricMatrix& a);

  const FactorStatistics& statistics() const override { return statistics_; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const override;
  /// The factorisation interchanges rows: growth is 1, or infinite if the sign of an eigenvalue is lost in rounding.
  std::optional<PivotSigns> count_signs(const SymmetricMatrix& a, const std::vector<double>& scale) const override;

 private:
  Eigen::MatrixXd lower_;
  FactorStatistics statistics_;
};

}  // namespace bielle
