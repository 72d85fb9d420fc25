#include "reduce/dense/symmetric_eigenpairs.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "reduce/common/error.hpp"

namespace bielle {

using Eigen::MatrixXd;

SymmetricEigenpairs symmetric_eigenpairs(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  if (eigen.info() != Eigen::Success) throw ComputationError("no eigenvalues of a symmetric matrix were found");
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

std::optional<SymmetricEigenpairs> symmetric_eigenpairs(const MatrixXd& A, const MatrixXd& B) {
  // With B = L L^T: L^-1 A L^-T y = lambda y, v = L^-T y.
  const Eigen::LLT<MatrixXd> factor(B);
  if (factor.info() != Eigen::Success) return {};
  MatrixXd C = A.selfadjointView<Eigen::Lower>();
  factor.matrixL().solveInPlace<Eigen::OnTheLeft>(C);
  factor.matrixU().solveInPlace<Eigen::OnTheRight>(C);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(C);
  if (eigen.info() != Eigen::Success) return {};
  SymmetricEigenpairs pairs{eigen.eigenvalues(), eigen.eigenvectors()};
  factor.matrixU().solveInPlace(pairs.vectors);
  return pairs;
}

}  // namespace bielle
