// The factor of a symmetric positive definite matrix, whoever made it and wherever it is kept: CHOLMOD
// (symmetric_factor.hpp), LAPACK for the small (dense_factor.hpp), MUMPS on ranks (reduce/distributed).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/error.hpp"
#include "reduce/sparse/pivot_signs.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle {

/// A pivot that is so much smaller than its diagonal entry: the matrix is singular to working precision.
constexpr double singular_pivot = 1e-14;

/// Cost of a factorisation.
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

class Factor {
 public:
  virtual ~Factor() = default;

  virtual const FactorStatistics& statistics() const = 0;
  std::int64_t size() const { return statistics().unknowns; }

  /// A^-1 b for a block of right-hand sides (size,k). Solutions are bound by memory: many columns cost less each than
  /// one, so ask for all at once.
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const = 0;

  /// How many eigenvalues of another symmetric matrix, not necessarily definite, are negative: by another factorisation
  /// in the same order, of which nothing is kept (pivot_signs.hpp). Nothing where that cannot be done.
  /// @param a      the unknowns of that which was factorised, then any number more, which are eliminated at last
  /// @param scale  of each unknown, the size of its diagonal entry
  /// @throws ComputationError when memory does not suffice
  virtual std::optional<PivotSigns> count_signs(const SymmetricMatrix& /*a*/,
                                                const std::vector<double>& /*scale*/) const {
    return std::nullopt;
  }

 protected:
  Factor() = default;
  Factor(const Factor&) = default;
  Factor& operator=(const Factor&) = default;
};

}  // namespace bielle
