// A factor in single precision, and solutions with it that are as good as those of one in double precision: half the
// memory, but each solution reads the factor several times.
//
// The matrix is scaled to a diagonal of ones. The factor is the preconditioner of conjugate gradients in double
// precision: what single precision spoils are a few directions in which the matrix is soft, which these find in a few
// steps, where mere refinement would creep (contraction 0.03 to 0.1 for a connecting rod of 1e5 to 3e5 unknowns, 4 to 7
// steps to 1e-11). References: A. Buttari et al., ACM Trans. Math. Software 34 (2008) 17; M. Arioli, I. S. Duff,
// Electron. Trans. Numer. Anal. 33 (2009) 31.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "reduce/spectral/bordered_part.hpp"
#include "reduce/spectral/numeric_factor.hpp"

namespace bielle {

class RefinedFactor {
 public:
  /// @param a  its `whole` outlives this
  /// @throws NotPositiveDefinite also where the matrix is too badly conditioned for single precision; std::bad_alloc
  RefinedFactor(const FactorStructure& structure, const Multifrontal& elimination, const BorderedPart& a, int threads);

  const Pivots& pivots() const { return factor_.pivots(); }  ///< of the scaled matrix

  /// A^-1 b (size,k). The energy of the error is about 1e-22 of the solution's.
  /// @throws ComputationError where the matrix is too badly conditioned for single precision
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// About A^-1 b: symmetric and positive definite.
  Eigen::MatrixXd precondition(const Eigen::MatrixXd& b) const;

 private:
  Eigen::MatrixXd solve_few(const Eigen::MatrixXd& b) const;

  std::vector<std::int64_t> kept_;
  BorderedPart a_;
  int threads_;
  Eigen::VectorXd scale_;
  NumericFactor<float> factor_;
};

}  // namespace bielle
