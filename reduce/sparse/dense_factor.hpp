// The factor of a small symmetric positive definite matrix, kept as a dense one (LAPACK).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/sparse/factor.hpp"

namespace bielle {

/// Matrices of up to so many unknowns are factorised densely: a factorisation with 200 solutions then takes less time
/// than CHOLMOD's (tests/performance/reduce_small_factors).
constexpr std::int64_t most_dense_unknowns = 200;

/// A = L L^T. Several threads may ask for solutions at the same time; each computes its own alone.
class DenseFactor : public Factor {
 public:
  /// @param a  positive definite; memory grows with the square of its size
  /// @throws NotPositiveDefinite also when a pivot is so small (`singular_pivot`) that A is singular to working
  ///         precision
  explicit DenseFactor(const SymmetricMatrix& a);

  const FactorStatistics& statistics() const override { return statistics_; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const override;
  /// With interchanges: growth is 1, or infinite where the sign of an eigenvalue is lost in rounding.
  std::optional<PivotSigns> count_signs(const SymmetricMatrix& a, const std::vector<double>& scale) const override;

 private:
  Eigen::MatrixXd lower_;
  FactorStatistics statistics_;
};

}  // namespace bielle
