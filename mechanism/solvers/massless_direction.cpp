#include "mechanism/solvers/massless_direction.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

namespace bielle::mechanism {

std::optional<Vector6> massless_direction(const System& system, const std::vector<double>& mass, int node) {
  const NodeFreedom& freedom = system.kinematics().freedom(node);
  if (!freedom.all_free) return {};
  Matrix6 M = Matrix6::Zero();
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const int place = system.pattern().find(freedom.begin + row, freedom.begin + column);
      if (place >= 0) M(row, column) = mass[static_cast<std::size_t>(place)];
    }
  if (M.diagonal().minCoeff() <= 0) return {};
  const Vector6 scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(scale.asDiagonal() * M * scale.asDiagonal());
  constexpr double rounding = 1e-12;
  if (eigen.eigenvalues()[0] > rounding) return {};
  const Vector6 direction = scale.asDiagonal() * eigen.eigenvectors().col(0);
  Eigen::Index largest = 0;
  direction.tail<3>().cwiseAbs().maxCoeff(&largest);  // the sign is free
  return direction / std::copysign(direction.tail<3>().norm(), direction[3 + largest]);
}

std::string massless_name(const System& system, int node, const Vector6& direction) {
  // Rounding residue reads as zero.
  const Vector3 axis = direction.tail<3>().unaryExpr([](double x) { return std::abs(x) < 1e-14 ? 0.0 : x; });
  return fmt::format("rotation of node '{}' about ({:.6g}, {:.6g}, {:.6g}) in its axes", system.model().node(node).name,
                     axis.x(), axis.y(), axis.z());
}

}  // namespace bielle::mechanism
