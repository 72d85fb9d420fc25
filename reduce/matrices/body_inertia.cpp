#include "reduce/matrices/body_inertia.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

/// Deviation in rigid motions, relative to M~, up to which the nodes' blocks count as those of rigid clouds.
constexpr double rigid_clouds = 1e-6;

Eigen::MatrixXd sum_of(const std::array<Eigen::MatrixXd, 6>& components) {
  return components[0] + components[1] + components[2];
}

/// Gives each direction a third of the difference to M~. @returns the difference
Eigen::MatrixXd complete(std::array<Eigen::MatrixXd, 6>& components, const Eigen::MatrixXd& mass) {
  Eigen::MatrixXd rest = mass - sum_of(components);
  rest = Eigen::MatrixXd((rest + rest.transpose()) / 2);
  for (std::size_t k = 0; k < 3; ++k) {
    components[k] += rest / 3;
    components[k] = Eigen::MatrixXd((components[k] + components[k].transpose()) / 2);
  }
  return rest;
}

/// Largest |v^T rest v| / v^T mass v of some motions v.
double largest_share(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& motions) {
  double result = 0;
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const Eigen::VectorXd v = motions.col(k);
    result = std::max(result, std::abs(v.dot(rest * v)) / v.dot(mass * v));
  }
  return result;
}

/// Whether M's blocks between nodes explain the rigid motions of the body.
bool explains_rigid_motions(const std::array<Eigen::MatrixXd, 6>& components, const Eigen::MatrixXd& mass,
                            const Eigen::MatrixXd& rigid) {
  const Eigen::MatrixXd rest = congruent(mass - sum_of(components), rigid), whole = congruent(mass, rigid);
  for (Eigen::Index k = 0; k < 6; ++k)
    for (Eigen::Index l = 0; l < 6; ++l)
      if (std::abs(rest(k, l)) > rigid_clouds * std::sqrt(whole(k, k) * whole(l, l))) return false;
  return true;
}

}  // namespace

std::array<Eigen::MatrixXd, 6> inertia_of_points(const NodalShapes& points, const Eigen::MatrixXd& displacement,
                                                 const Eigen::MatrixXd& rotation) {
  std::array<Eigen::MatrixXd, 6> result;
  const Eigen::Index p = points.points.cols(), n = displacement.cols();
  const auto rows = [&](const Eigen::MatrixXd& matrix, int k) {
    return Eigen::MatrixXd(matrix(Eigen::seqN(k, p, 3), Eigen::all));
  };
  for (std::size_t s = 0; s < 6; ++s) {
    const auto [k, l] = voigt_pairs[s];
    result[s] = transposed_product(rows(displacement, k), points.masses.asDiagonal() * rows(displacement, l));
  }
  if (points.inertias.empty() || rotation.size() == 0) return result;
  for (Eigen::Index a = 0; a < p; ++a) {
    const Eigen::Matrix3d& J = points.inertias[static_cast<std::size_t>(a)];
    const Eigen::Matrix3d cloud = J.trace() / 2 * Eigen::Matrix3d::Identity() - J;
    const Eigen::MatrixXd turn = rotation.middleRows(3 * a, 3);
    for (std::size_t s = 0; s < 6; ++s) {
      const auto [k, l] = voigt_pairs[s];
      Eigen::MatrixXd left(3, n), right(3, n);
      left = skew(Eigen::Vector3d::Unit(k)) * turn;
      right = cloud * (skew(Eigen::Vector3d::Unit(l)) * turn);
      result[s] += transposed_product(left, right);
    }
  }
  return result;
}

std::string BodyInertia::told() const {
  switch (source) {
    case InertiaSource::file:
      return "the inertia of large rotations is that of the file";
    case InertiaSource::shapes:
      return fmt::format(
          "the inertia of large rotations is that of the file's shapes and point masses, which leave "
          "{:.2g} % of the kinetic energy of free modes open",
          100 * unknown_share);
    case InertiaSource::nodes:
      return fmt::format(
          "the inertia of large rotations is that of the nodes; the mass matrix has up to {:.2g} % of "
          "the kinetic energy of free modes in terms that do not turn with the body",
          100 * unknown_share);
    case InertiaSource::estimate: {
      const auto percent = [&](std::size_t k) {
        return shown[k] < 0 ? std::string("none needed") : fmt::format("{:.0f} %", 100 * shown[k]);
      };
      return fmt::format(
          "the inertia of large rotations is an estimate, since reduced matrices alone do not tell in which direction "
          "the inside moves: exact for the rigid body; the change of inertia with stretching along the principal axes "
          "is "
          "known to {}, {}, {}; of the kinetic energy of a free mode up to {:.0f} % has no known direction, so that "
          "its "
          "gyroscopic terms are left out. Shapes with point masses, or full matrices, make it exact",
          percent(0), percent(1), percent(2), 100 * unknown_share);
    }
  }
  return "";
}

BodyInertia body_inertia(const MatrixSet& set, const Eigen::MatrixXd& shapes, const std::vector<Interface>& interfaces,
                         const Eigen::MatrixXd& mass, const MassProperties& body, const Eigen::MatrixXd& rigid,
                         const Eigen::MatrixXd& modes) {
  BodyInertia result;
  if (set.inertia_components[0].size() > 0) {
    for (std::size_t s = 0; s < 6; ++s) result.components[s] = congruent(set.inertia_components[s], shapes);
  } else if (set.shapes && set.shapes->masses.size() > 0) {
    const NodalShapes& points = *set.shapes;
    result.source = InertiaSource::shapes;
    result.components =
        inertia_of_points(points, product(points.displacement, shapes),
                          points.rotation.size() > 0 ? product(points.rotation, shapes) : Eigen::MatrixXd());
  } else {
    result.source = InertiaSource::nodes;
    result.components = inertia_of_nodes(set, shapes);
    if (set.scalars() > 0 || !explains_rigid_motions(result.components, mass, rigid)) {
      result.source = InertiaSource::estimate;
      result.components = estimated_inertia(interfaces, mass, body, rigid, result.shown);
    }
  }
  const Eigen::MatrixXd rest = complete(result.components, mass);
  result.unknown_share = modes.cols() > 0 ? largest_share(rest, mass, modes) : 0;
  return result;
}

}  // namespace bielle::reduce
