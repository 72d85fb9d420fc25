#include "mechanism/joints/path_press.hpp"

namespace bielle::mechanism {

Vector6 take_out_along_path(const Vector6& reaction, const Vector3& along) {
  const Vector3 t = along.normalized();
  Vector6 press = reaction;
  press.head<3>() -= t.dot(reaction.head<3>()) * t;
  return press;
}

Vector6 take_out_along_path(const Vector6& reaction, const Vector3& along,
                            const Eigen::Matrix<double, 3, Eigen::Dynamic>& by_position, MatrixX& derivatives) {
  const double speed = along.norm();
  const Vector3 t = along / speed, F = reaction.head<3>();
  const Matrix3 normal = Matrix3::Identity() - t * t.transpose();
  Matrix3 by_t = t * F.transpose();
  by_t.diagonal().array() += t.dot(F);
  const Matrix3 by_along = by_t * normal / speed;
  for (Eigen::Index k = 0; k < derivatives.cols(); ++k) {
    const Vector3 dF = derivatives.col(k).head<3>();
    derivatives.col(k).head<3>() = normal * dF - by_along * by_position.col(k);
  }
  return take_out_along_path(reaction, along);
}

}  // namespace bielle::mechanism
