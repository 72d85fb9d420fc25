#include "reduce/matrices/body_inertia.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/percent.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/matrices/shown_moments.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

// Smallest number of points whose shapes determine the directions of inertia.
constexpr Eigen::Index fewest_points = 10;

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

/// Returns the largest |v^T rest v| / v^T mass v of some motions v.
double largest_share(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& motions) {
  double result = 0;
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const Eigen::VectorXd v = motions.col(k);
    result = std::max(result, std::abs(v.dot(rest * v)) / v.dot(mass * v));
  }
  return result;
}

/// Returns whether components add up to M~ to the digits of text formats.
bool add_up(const std::array<Eigen::MatrixXd, 6>& components, const Eigen::MatrixXd& mass) {
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (mass - sum_of(components)) * scale.asDiagonal()).cwiseAbs().maxCoeff() < 1e-6;
}

/// Returns S_kl of equal point masses at the points of the shapes.
std::array<Eigen::MatrixXd, 6> equal_masses(NodalShapes points, const Eigen::MatrixXd& shapes, double mass) {
  points.masses.setConstant(points.points.cols(), mass / static_cast<double>(points.points.cols()));
  points.inertias.clear();
  return inertia_of_points(points, product(points.displacement, shapes), {});
}

/// Replaces the moments of the nodes by those of the interfaces where these show nearly all of the deformation.
void take_shown(const ShownMoments& shown, const Eigen::Matrix3d& axes, RestMoments& moments) {
  constexpr double in_full = 0.9;
  RestMoments principal = turned_moments(moments, axes);
  for (std::size_t s = 0; s < 6; ++s) {
    if (shown.shares[s] < in_full) continue;
    const auto k = static_cast<std::size_t>(voigt_pairs[s][0]), l = static_cast<std::size_t>(voigt_pairs[s][1]);
    principal[k][l] = principal[l][k] = shown.moments[s];
  }
  moments = turned_moments(principal, axes.transpose());
}

/// Translations move the mass in their own direction alone. Components that differ by more belong to another body or
/// order of unknowns; smaller differences, as of lumped masses, are completed.
/// @param translations (n,3) coordinates @throws InputError
void check_translation(const MatrixSet& set, const std::array<Eigen::MatrixXd, 6>& components, double mass,
                       const Eigen::MatrixXd& translations) {
  constexpr double most = 0.1;
  double largest = 0;
  for (std::size_t s = 0; s < 6; ++s) {
    Eigen::Matrix3d found = congruent(components[s], translations);
    found(voigt_pairs[s][0], voigt_pairs[s][1]) -= mass;
    largest = std::max(largest, found.cwiseAbs().maxCoeff() / mass);
  }
  if (largest > most)
    throw InputError(fmt::format("{}: translated, the body has inertia components that differ from its mass by {}",
                                 set.source, percent(largest)));
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
          "{} of the kinetic energy of free modes open",
          percent(unknown_share));
    case InertiaSource::nodes:
      return "the inertia of large rotations is that of the nodes";
    case InertiaSource::nearly_nodes:
      return fmt::format(
          "the inertia of large rotations is that of the nodes; the mass matrix has terms that do not turn "
          "with them, as where axial and lateral mass of a beam differ or rotations have no mass{}",
          unknown_share < 0.005 ? std::string()
                                : fmt::format(": of the kinetic energy of a free mode up to {:.0f} % has "
                                              "no known direction",
                                              100 * unknown_share));
    case InertiaSource::equal_masses:
      return fmt::format(
          "the inertia of large rotations is an estimate with the directions of the file's shapes, as if "
          "their points had equal masses; that of the rigid body is exact{}",
          unknown_share < 0.01 ? ""
                               : fmt::format(", and of the kinetic energy of a free mode up to {:.0f} % has "
                                             "no known direction",
                                             100 * unknown_share));
    case InertiaSource::estimate: {
      const auto told = [&](std::size_t k) {
        return shown[k] < 0 ? std::string("(none needed)") : fmt::format("{:.0f} %", 100 * shown[k]);
      };
      return fmt::format(
          "the inertia of large rotations is an estimate: reduced matrices do not tell in which direction the inside "
          "moves. "
          "That of the rigid body is exact; its change by stretching along the principal axes is shown by the "
          "interfaces to "
          "{}, {} and {}; of the kinetic energy of a free mode up to {:.0f} % has no known direction, and its "
          "gyroscopic "
          "terms are left out. Full matrices, or shapes with point masses, make it exact",
          told(0), told(1), told(2), 100 * unknown_share);
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
    check_translation(set, result.components, body.mass, rigid.leftCols(3));
  } else if (set.shapes && set.shapes->masses.size() > 0) {
    const NodalShapes& points = *set.shapes;
    result.source = InertiaSource::shapes;
    result.components =
        inertia_of_points(points, product(points.displacement, shapes),
                          points.rotation.size() > 0 ? product(points.rotation, shapes) : Eigen::MatrixXd());
  } else {
    std::array<Eigen::MatrixXd, 6> known = inertia_of_nodes(set, shapes);
    const RigidSplit split = split_rigid(mass, body, rigid);
    result.source = add_up(known, mass) ? InertiaSource::nodes : InertiaSource::estimate;
    if (result.source == InertiaSource::nodes) {
      result.components = normalised_inertia(known, mass);
      return result;
    }
    const bool has_shapes = set.shapes && set.shapes->points.cols() >= fewest_points;
    if (has_shapes) {
      result.source = InertiaSource::equal_masses;
      known = equal_masses(*set.shapes, shapes, body.mass);
    }
    if (result.source == InertiaSource::estimate && set.scalars() == 0) result.source = InertiaSource::nearly_nodes;
    if (!has_shapes && !is_semidefinite(known)) known = inertia_of_nodes(set, shapes, false);
    RestInertia rest = rest_inertia(known, mass, split);
    if (!has_shapes) {
      const ShownMoments shown = shown_moments(interfaces, mass, body.centre, split);
      take_shown(shown, split.axes, rest.moments);
      result.shown = shown.shares;
    }
    result.components = joined_inertia(split, rest, mass);
    complete(result.components, mass);
    result.unknown_share = modes.cols() > 0 ? largest_share(rest.open, mass, modes) : 0;
    return result;
  }
  const Eigen::MatrixXd rest = complete(result.components, mass);
  result.unknown_share = modes.cols() > 0 ? largest_share(rest, mass, modes) : 0;
  return result;
}

}  // namespace bielle::reduce
