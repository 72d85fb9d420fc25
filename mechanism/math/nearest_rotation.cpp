#include "mechanism/math/nearest_rotation.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

namespace bielle::mechanism {

std::optional<std::string> rotation_fault(const Matrix3& A) {
  const double fault = (A.transpose() * A - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(fault <= rotation_margin)) return fmt::format("lengths and angles of these are off by up to {:.2g}", fault);
  if (A.determinant() < 0) return "these are left-handed";
  return std::nullopt;
}

Matrix3 nearest_rotation(const Matrix3& A) {
  const Eigen::JacobiSVD<Matrix3> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace bielle::mechanism
