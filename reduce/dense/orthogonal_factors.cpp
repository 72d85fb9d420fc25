#include "reduce/dense/orthogonal_factors.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace bielle {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd orthogonal_basis(const MatrixXd& A) { return Eigen::HouseholderQR<MatrixXd>(A).householderQ(); }

std::vector<Eigen::Index> pivoted_columns(const MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<MatrixXd> factors(A);
  const auto& indices = factors.colsPermutation().indices();
  return {indices.begin(), indices.end()};
}

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(A).solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& A) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(A).pseudoInverse();
}

MatrixXd null_space(const MatrixXd& A, double dependent) {
  Eigen::ColPivHouseholderQR<MatrixXd> factors(A.cols(), A.rows());
  factors.setThreshold(dependent);
  factors.compute(A.transpose());
  const Eigen::Index left = A.cols() - factors.rank();
  MatrixXd basis = MatrixXd::Zero(A.cols(), left);
  basis.bottomRows(left).setIdentity();
  basis.applyOnTheLeft(factors.householderQ());
  return basis;
}

RightSingularVectors right_singular_vectors(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace bielle
