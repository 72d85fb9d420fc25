// Moments of the deformation of a reduced body that its interfaces show: they change the inertia of the body to first
// order, as the stretching of a spinning rod does.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "reduce/matrices/rigid_split.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

struct ShownMoments {
  /// Integral of rho d_k x_l of each coordinate (N) in principal axes of inertia, kl = 11 22 33 23 13 12.
  std::array<Eigen::RowVectorXd, 6> moments;
  /// Shares of the linear fields' energies that the interfaces show, 0 to 1; -1 if the body is thin there and needs
  /// none.
  std::array<double, 6> shares{};
};

/// @param mass  M~ (N,N), interface directions first
ShownMoments shown_moments(const std::vector<Interface>& interfaces, const Eigen::MatrixXd& mass,
                           const Eigen::Vector3d& centre, const RigidSplit& split);

}  // namespace bielle::reduce
