// The numbers of a factor, in double or in single precision, and solutions with them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "reduce/spectral/bordered_part.hpp"
#include "reduce/spectral/factor_structure.hpp"
#include "reduce/spectral/huge_pages.hpp"
#include "reduce/spectral/multifrontal.hpp"
#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

/// The squares of the diagonal of L.
struct Pivots {
  std::int64_t unknown = -1;  ///< of the smallest relative to the diagonal of what is factorised
  double relative = 1;        ///< how small
  double least_over_largest = 1;
};

/// @tparam Number  double or float
template <class Number>
class NumericFactor {
 public:
  /// L L^T = P S A S P^T.
  /// @param elimination  of the structure
  /// @param scale        the diagonal of S, of each unknown; empty: ones
  /// @param diagonal     of S A S
  /// @throws NotPositiveDefinite; std::bad_alloc
  NumericFactor(const FactorStructure& structure, const Multifrontal& elimination, const BorderedPart& a,
                std::span<const double> scale, std::span<const double> diagonal, int threads);

  const Pivots& pivots() const { return pivots_; }
  /// (S A S)^-1 b (size,k)
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const { return solver_.solve(b); }

 private:
  ZeroNumbers<Number> values_;
  Pivots pivots_;
  SupernodalSolver<Number> solver_;
};

}  // namespace bielle
