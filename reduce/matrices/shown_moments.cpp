// Moments of a deformation d that the interfaces show, in the principal axes of P = integral of rho x x^T about the
// centre. In the d-part of the symmetric linear field e_kl the energy is E_kk = P_kk and E_kl = P_kk P_ll / (P_kk +
// P_ll). The interfaces show the field by their positions and without rotation; its rigid part is taken away, and F is
// the energy of the remainder in M~. Then N_kl is the product with it, times min(1, E/F): a thin body has E = 0 and no
// such moment.
#include "reduce/matrices/shown_moments.hpp"

#include <algorithm>
#include <cmath>

#include "reduce/dense/dense_products.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/matrices/rigid_split.hpp"

namespace bielle::reduce {

namespace {

constexpr double thin_direction =
    1e-6;  // relative to the largest principal P: below, a body counts as thin in that direction

/// Returns the interface coordinates (N) of the field (e_k x_l + e_l x_k) / 2, or e_k x_k; axes: principal ones -> body
/// axes.
Eigen::VectorXd shown_field(const std::vector<Interface>& interfaces, Eigen::Index size, const Eigen::Vector3d& centre,
                            const Eigen::Matrix3d& axes, int k, int l) {
  const Eigen::Matrix3d gradient = (axes.col(k) * axes.col(l).transpose() + axes.col(l) * axes.col(k).transpose()) / 2;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size);
  Eigen::Index row = 0;
  for (const Interface& interface : interfaces)
    for (int axis = 0; axis < 6; ++axis) {
      if (!interface.kept[static_cast<std::size_t>(axis)]) continue;
      if (axis < 3) result(row) = interface.rotation.col(axis).dot(gradient * (interface.position - centre));
      ++row;
    }
  return result;
}

}  // namespace

ShownMoments shown_moments(const std::vector<Interface>& interfaces, const Eigen::MatrixXd& mass,
                           const Eigen::Vector3d& centre, const RigidSplit& split) {
  const Eigen::Vector3d& P = split.principal;
  const double least = thin_direction * P(2);
  ShownMoments result;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto [k, l] = voigt_pairs[s];
    const double energy = k == l ? P(k) : P(k) * P(l) / std::max(P(k) + P(l), 1e-300);
    result.moments[s].setZero(mass.rows());
    result.shares[s] = -1;
    if (energy <= least) continue;
    const Eigen::VectorXd field = split.rest * shown_field(interfaces, mass.rows(), centre, split.axes, k, l);
    const Eigen::VectorXd momentum = mass * field;
    const double found = field.dot(momentum);
    result.shares[s] = std::min(1.0, found / energy);
    if (found > 1e-12 * energy) result.moments[s] = std::min(1.0, energy / found) * momentum.transpose() * split.rest;
  }
  return result;
}

}  // namespace bielle::reduce
