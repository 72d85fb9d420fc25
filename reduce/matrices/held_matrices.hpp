// Foreign matrices with the interfaces held: one factorisation of the interior, and solutions with the conditions of
// average ties.
//
// A body that is held by average ties alone has a singular interior. K z = f with C^T z = q has the solution of
// (K + C G C^T) z = f + C (G q - l) for any G > 0, and the bracketed matrix is regular: it is factorised, and l follows
// from the conditions.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "reduce/matrices/matrix_set.hpp"
#include "reduce/matrices/node_interfaces.hpp"
#include "reduce/sparse/factor.hpp"

namespace bielle::reduce {

class HeldMatrices {
 public:
  /// The object keeps references to the set and the ties.
  /// @throws ComputationError if the interior is singular, which names the unknown
  HeldMatrices(const MatrixSet& set, const NodeTies& ties, int threads);

  Eigen::Index size() const { return ties_.inside.cols(); }
  const FactorStatistics& statistics() const { return factor_ ? factor_->statistics() : no_statistics_; }

  /// z for the forces f (m,k) on the interior. @param averages  values of the conditions (averages,k); empty: zeros
  Eigen::MatrixXd solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& averages = {}) const;
  /// M_ii z
  Eigen::MatrixXd inertia(const Eigen::MatrixXd& z) const;

 private:
  void factorise(int threads);

  const MatrixSet& set_;
  const NodeTies& ties_;
  SparseColumns mass_;          // (m,m)
  Eigen::MatrixXd conditions_;  // C (m, averages)
  std::unique_ptr<Factor> factor_;
  Eigen::MatrixXd answers_;      // response of the interior to unit forces of the conditions (m, averages)
  Eigen::MatrixXd multipliers_;  // inverse of C^T answers: multipliers for unit violations
  FactorStatistics no_statistics_;
};

}  // namespace bielle::reduce
