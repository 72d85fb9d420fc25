// LU factors of matrices with few rows. Blocked factorisations pay off from some thirty rows on; below, most of their
// time is overhead. The loops here run along columns and take a third of the time for twelve rows.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace bielle {

/// P A = L U with partial pivoting. Memory is allocated only if the size grows.
class SmallLU {
 public:
  /// Factorises A (n,n). A singular matrix has the determinant zero; its solutions are not finite.
  void compute(const Eigen::MatrixXd& A);
  double determinant() const { return determinant_; }
  /// x <- A^-1 x (n)
  void solve(Eigen::Ref<Eigen::VectorXd> x) const;
  /// x <- A^-T x (n)
  void solve_transposed(Eigen::Ref<Eigen::VectorXd> x) const;
  /// X <- A^-1 X (n,m)
  void solve_columns(Eigen::MatrixXd& X) const;

 private:
  Eigen::Index n_ = 0;
  std::vector<double> values_;          ///< by columns; L without its diagonal of ones
  std::vector<Eigen::Index> exchange_;  ///< row that was exchanged with row k
  double determinant_ = 1;
};

}  // namespace bielle
