#include "tests/support/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace bielle::test {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

}  // namespace bielle::test
