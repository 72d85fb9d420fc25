#include "reduce/reduction/rigid_motions.hpp"

#include "reduce/dense/orthogonal_factors.hpp"

namespace bielle::reduce {

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  return (Eigen::Matrix3d() << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0).finished();
}

RowMatrix rigid_motions(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& about) {
  RowMatrix result(3 * points.cols(), 6);
  for (Eigen::Index a = 0; a < points.cols(); ++a) {
    result.middleRows<3>(3 * a) << Eigen::Matrix3d::Identity(), -skew(points.col(a) - about);
  }
  return result;
}

Eigen::Matrix<double, 1, 6> interface_rigid_motion(const Interface& interface, int axis, const Eigen::Vector3d& about) {
  const Eigen::RowVector3d direction = interface.rotation.col(axis % 3).transpose();
  Eigen::Matrix<double, 1, 6> result;
  if (axis < 3) {
    result << direction, -direction * skew(interface.position - about);
  } else {
    result << Eigen::RowVector3d::Zero(), direction;
  }
  return result;
}

Eigen::MatrixXd interface_rigid_motions(const std::vector<Interface>& interfaces, const Eigen::Vector3d& about) {
  Eigen::MatrixXd result(0, 6);
  for (const Interface& interface : interfaces) {
    for (int axis = 0; axis < 6; ++axis) {
      if (interface.kept[axis]) {
        result.conservativeResize(result.rows() + 1, Eigen::NoChange);
        result.bottomRows<1>() = interface_rigid_motion(interface, axis, about);
      }
    }
  }
  return result;
}

Eigen::MatrixXd nearest_rigid_motion(const std::vector<Interface>& interfaces, const Eigen::Vector3d& about,
                                     double length) {
  const Eigen::MatrixXd u = interface_rigid_motions(interfaces, about);
  Eigen::VectorXd row_scale(u.rows());
  Eigen::Index row = 0;
  for (const Interface& interface : interfaces) {
    for (int axis = 0; axis < 6; ++axis) {
      if (interface.kept[axis]) {
        row_scale(row++) = axis < 3 ? 1 : length;
      }
    }
  }
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(6);
  scale.tail<3>().setConstant(1 / length);
  const Eigen::MatrixXd scaled = row_scale.asDiagonal() * u * scale.asDiagonal();
  return scale.asDiagonal() * pseudo_inverse(scaled) * row_scale.asDiagonal();
}

}  // namespace bielle::reduce
