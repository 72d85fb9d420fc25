#include "mechanism/math/inverse.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace bielle::mechanism {

Matrix6 inverse(const Matrix6& A) { return A.inverse(); }

Matrix6 symmetric_inverse(const Matrix6& A) {
  const Matrix6 B = A.llt().solve(Matrix6::Identity());
  return 0.5 * (B + B.transpose());
}

}  // namespace bielle::mechanism
