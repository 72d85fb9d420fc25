// Damping of a reduced body: ratios of its free modes, or Rayleigh's two factors.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace bielle {

struct Superelement;

/// Rigid motions of a body in its own coordinates: (n,6), three translations, then rotations about the origin.
Eigen::MatrixXd rigid_motions(const Superelement& body);

/// C~ = sum over the elastic free modes of 2 zeta omega (M~ v)(M~ v)^T, v^T M~ v = 1: each mode of the free body has
/// its damping ratio, and rigid motions are not damped.
/// @param ratios  zeta of the first, second ... elastic mode, >= 0; the last holds for all further ones
/// @throws InputError if there are none, or more ratios than elastic modes; ComputationError if M~ is not positive
/// definite
Eigen::MatrixXd modal_damping(const Superelement& body, const std::vector<double>& ratios);

/// C~ = alpha M~ + beta K~.
/// @param alpha  [1/s]; acts on motions relative to the body's frame; @param beta  [s]
Eigen::MatrixXd rayleigh_damping(const Superelement& body, double alpha, double beta);

}  // namespace bielle
