// Interface of the factor of a symmetric positive definite matrix, with implementations by CHOLMOD
// (symmetric_factor.hpp), LAPACK for small matrices (dense_factor.hpp), and MUMPS on ranks (reduce/distributed).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/error.hpp"
#include "reduce/sparse/pivot_signs.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle {

/// If the ratio of a pivot to its diagonal entry is below this, the matrix is singular to working precision.
constexpr double singular_pivot = 1e-14;

/// Cost of a factorisation.
struct FactorStatistics {
  std::int64_t unknowns = 0;
  std::int64_t nonzeros = 0;  ///< entries of L
  double flops = 0;
  double estimated_MB = 0;  ///< memory for the factorisation, known before it starts [1e6 bytes]
  double ordering_seconds = 0, analysis_seconds = 0, factorisation_seconds = 0;  ///< wall time
  double reciprocal_condition = 0;  ///< rough: (smallest / largest diagonal entry of L)^2

  double speed() const { return 1e-9 * flops / factorisation_seconds; }  ///< [GFLOP/s]
  double memory_MB() const { return 8e-6 * static_cast<double>(nonzeros); }
  double seconds() const { return ordering_seconds + analysis_seconds + factorisation_seconds; }
};

/// The matrix is singular or indefinite; the caller adds the meaning of the unknown to the user.
class NotPositiveDefinite : public ComputationError {
 public:
  explicit NotPositiveDefinite(std::int64_t unknown);
  std::int64_t unknown() const {
    return unknown_;
  }  ///< unknown at which the elimination met a pivot that is not
     ///< positive

 private:
  std::int64_t unknown_;
};

class Factor {
 public:
  virtual ~Factor() = default;

  virtual const FactorStatistics& statistics() const = 0;
  std::int64_t size() const { return statistics().unknowns; }

  /// A^-1 b for a block of right-hand sides (size,k). The time of solutions is limited by memory bandwidth: the cost
  /// per column is lower for many columns, so pass all at once.
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const = 0;

  /// Number of negative eigenvalues of another symmetric matrix, not necessarily definite, by another factorisation in
  /// the same order, which is not kept (pivot_signs.hpp). It returns nothing if that is impossible.
  /// @param a      the unknowns of the factorised matrix, followed by any number of others, which are eliminated last
  /// @param scale  absolute value of the diagonal entry of each unknown
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
