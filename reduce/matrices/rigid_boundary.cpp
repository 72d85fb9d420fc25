#include "reduce/matrices/rigid_boundary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

/// Force of a rigid motion relative to the stiffness that it would meet without cancellation: text formats leave 1e-8.
constexpr double grounded = 1e-5;
/// The same relative to the stiffest spring between nodes, for one average tie, whose directions meet no stiffness.
constexpr double grounded_average = 1e-8;

/// The largest force of a unit rigid motion, with rotations and moments in terms of the radius of gyration.
struct RigidForce {
  double relative = 0;
  Eigen::Index direction = 0, motion = 0;
};

/// Returns the units of the kept directions: 1 for translations, the radius of gyration for rotations.
Eigen::VectorXd unit_lengths(const std::vector<Interface>& interfaces, Eigen::Index kept, double length) {
  Eigen::VectorXd result(kept);
  Eigen::Index row = 0;
  for (const Interface& interface : interfaces)
    for (std::size_t axis = 0; axis < 6; ++axis)
      if (interface.kept[axis]) result(row++) = axis < 3 ? 1 : length;
  return result;
}

RigidForce largest_force(const Eigen::MatrixXd& forces, const Eigen::VectorXd& units, double length, double stiffness) {
  RigidForce worst;
  for (Eigen::Index k = 0; k < 6; ++k)
    for (Eigen::Index i = 0; i < forces.rows(); ++i) {
      const double relative = std::abs(forces(i, k)) / (units(i) * (k < 3 ? 1 : length) * std::max(stiffness, 1e-300));
      if (relative > worst.relative) worst = {relative, i, k};
    }
  return worst;
}

[[noreturn]] void refuse_forces(const MatrixSet& set, const NodeTies& ties, const RigidForce& worst) {
  constexpr std::array<const char*, 6> motions = {"translation along x", "translation along y", "translation along z",
                                                  "rotation about x",    "rotation about y",    "rotation about z"};
  throw InputError(fmt::format(
      "{}: a rigid {} of the body causes forces, {:.2g} of its stiffness, most at {}: the stiffness is held to the "
      "ground, or it does not belong to these positions, axes and units of the nodes. bielle-reduce --verify tells "
      "which",
      set.source, motions[static_cast<std::size_t>(worst.motion)], worst.relative,
      name_of_kept(ties.interfaces, worst.direction)));
}

}  // namespace

Eigen::MatrixXd boundary_stiffness(const MatrixSet& set, const NodeTies& ties, const Eigen::MatrixXd& condensed,
                                   const MassProperties& body) {
  const Eigen::Index kept = condensed.rows();
  const Eigen::MatrixXd rigid = interface_rigid_motions(ties.interfaces, body.centre);
  const double length = radius_of_gyration(body);
  const Eigen::VectorXd units = unit_lengths(ties.interfaces, kept, length);
  const bool one_average = ties.averages.size() == static_cast<std::size_t>(kept) && kept <= 6;
  // The stiffness that a direction would meet if all else were held.
  const SparseColumns alone = ties.carry.transpose() * set.stiffness * ties.carry;
  // Directions that hold the body statically determinate have no stiffness but rounding.
  const double rounding = (set.scalars() > 0 ? 1e-5 : 1e-8) * reference_eigenvalue(set) * body.mass;
  const double stiffness =
      rounding + (one_average
                      ? set.stiffness.diagonal().maxCoeff()
                      : alone.diagonal().cwiseMax(condensed.diagonal()).cwiseQuotient(units.cwiseAbs2()).maxCoeff());
  const RigidForce worst = largest_force(product(condensed, rigid), units, length, stiffness);
  if (worst.relative > (one_average ? grounded_average : grounded)) refuse_forces(set, ties, worst);
  if (kept <= 6) return Eigen::MatrixXd::Zero(kept, kept);  // rigid motions alone: no rounding is left
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(kept, kept) -
                               product(rigid, nearest_rigid_motion(ties.interfaces, body.centre, length));
  const Eigen::MatrixXd elastic = congruent(condensed, rest);
  return (elastic + elastic.transpose()) / 2;
}

void put_exact_rigid_motions(const std::vector<Interface>& interfaces, const MassProperties& body,
                             const Eigen::Matrix3Xd& points, Eigen::MatrixXd& displacement) {
  const Eigen::MatrixXd rigid = interface_rigid_motions(interfaces, body.centre);
  const Eigen::MatrixXd nearest = nearest_rigid_motion(interfaces, body.centre, radius_of_gyration(body));
  const Eigen::Index kept = rigid.rows();
  const Eigen::MatrixXd found = product(displacement.leftCols(kept), rigid);
  const Eigen::MatrixXd missing = Eigen::MatrixXd(rigid_motions(points, body.centre)) - found;
  displacement.leftCols(kept) += product(missing, nearest);
}

}  // namespace bielle::reduce
