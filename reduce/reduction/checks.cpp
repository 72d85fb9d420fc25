#include "reduce/reduction/checks.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/geometric_checks.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

void add_stiffness_checks(const Superelement& body, std::vector<Check>& checks) {
  const Eigen::MatrixXd u = rigid_coordinates(body, body.centre);
  checks.push_back({"rigid_motion_force", relative_force(body.stiffness, body.mass, u), 1e-12,
                    "moved as a whole, the body feels no force"});
  // The comparison is made in coordinates of unit mass, so that amplitudes and displacements are comparable.
  const Eigen::VectorXd scale = body.mass.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd values = symmetric_eigenpairs(scale.asDiagonal() * body.stiffness * scale.asDiagonal()).values;
  checks.push_back({"negative_energy", std::max(0.0, -values.minCoeff()) / std::max(values.maxCoeff(), 1e-300), 1e-9,
                    "no deformation releases energy"});
}

void add_mass_checks(const Superelement& body, std::vector<Check>& checks) {
  const ReducedMassProperties reduced = reduced_mass_properties(body);
  checks.push_back({"mass_error", std::abs(reduced.mass / body.total_mass - 1), 1e-10, "its mass is that of the mesh"});
  checks.push_back({"centre_error", (reduced.centre - body.centre).norm() / radius_of_gyration(mass_properties(body)),
                    1e-10, "its centre of mass is that of the mesh, in radii of gyration"});
  checks.push_back({"inertia_error", (reduced.inertia - body.inertia).norm() / body.inertia.norm(), 1e-10,
                    "its inertia is that of the mesh"});
  const Eigen::MatrixXd sum = body.inertia_components[0] + body.inertia_components[1] + body.inertia_components[2];
  const Eigen::VectorXd scale = body.mass.diagonal().cwiseSqrt().cwiseInverse();
  checks.push_back({"inertia_components_error",
                    (scale.asDiagonal() * (sum - body.mass) * scale.asDiagonal()).cwiseAbs().maxCoeff(), 1e-9,
                    "the parts of its mass along x, y and z add up"});
  const Eigen::Index m = body.modes();
  if (m > 0) {
    const Eigen::MatrixXd modal = body.mass.bottomRightCorner(m, m);
    checks.push_back({"mode_orthogonality", (modal - Eigen::MatrixXd::Identity(m, m)).cwiseAbs().maxCoeff(), 1e-7,
                      "no mode moves the mass of another"});
  }
}

void add_recovery_checks(const Superelement& body, std::vector<Check>& checks) {
  const Eigen::MatrixXd u = rigid_coordinates(body, body.centre);
  if (body.displacement_recovery.size() > 0) {
    const double length = radius_of_gyration(mass_properties(body));
    const Eigen::VectorXd scale = (Eigen::VectorXd(6) << 1, 1, 1, 1 / length, 1 / length, 1 / length).finished();
    const Eigen::MatrixXd error =
        body.displacement_recovery * u - Eigen::MatrixXd(rigid_motions(body.mesh.points, body.centre));
    checks.push_back({"rigid_motion_recovery", (error * scale.asDiagonal()).cwiseAbs().maxCoeff(), 1e-10,
                      "moved as a whole, the body shows that motion everywhere"});
  }
  const Eigen::Index m = body.modes(), directions = body.interface_directions();
  if (body.stress_recovery.size() > 0 && body.size() > 6) {
    // The stress is relative to that of unit displacements: of the interfaces, and of modes with an amplitude of
    // sqrt(mass).
    double largest =
        (body.stress_recovery.leftCols(directions).cwiseAbs() * u.topRows(directions).cwiseAbs()).maxCoeff();
    if (m > 0) {
      largest = std::max(largest, std::sqrt(body.total_mass) * body.stress_recovery.rightCols(m).cwiseAbs().maxCoeff());
    }
    checks.push_back({"rigid_motion_stress", (body.stress_recovery * u).cwiseAbs().maxCoeff() / largest, 1e-8,
                      "moved as a whole, the body shows no stress"});
  }
}

}  // namespace

/// Returns U in all n coordinates: rigid motions have no component in fixed-boundary modes.
Eigen::MatrixXd rigid_coordinates(const Superelement& body, const Eigen::Vector3d& about) {
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(body.size(), 6);
  u.topRows(body.interface_directions()) = interface_rigid_motions(body.interfaces, about);
  return u;
}

MassProperties mass_properties(const Superelement& body) {
  MassProperties result;
  result.mass = body.total_mass;
  result.centre = body.centre;
  result.inertia = body.inertia;
  return result;
}

void fail_when_a_check_does(const std::vector<Check>& checks, const std::string& what) {
  for (const Check& check : checks) {
    if (!check.passed()) {
      throw ComputationError(
          fmt::format("{} fails the check '{}' by {:.2e}, at most {:.0e} is right; a very slender or "
                      "distorted mesh may be the cause",
                      what, check.meaning, check.value, check.limit));
    }
  }
}

double relative_force(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& motions) {
  // Coordinates are scaled to unit mass, so that amplitudes, displacements and angles are comparable.
  const Eigen::VectorXd unit = mass.diagonal().cwiseSqrt();
  const Eigen::MatrixXd k = unit.cwiseInverse().asDiagonal() * stiffness * unit.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd u = unit.asDiagonal() * motions;
  Eigen::VectorXd root = k.diagonal().cwiseMax(0).cwiseSqrt();
  if (root.maxCoeff() == 0) {
    return k.cwiseAbs().maxCoeff();
  }
  const double largest = root.maxCoeff();
  root = Eigen::VectorXd(root.cwiseMax(1e-8 * largest));  // a direction may meet no stiffness at all
  const Eigen::MatrixXd forces = root.cwiseInverse().asDiagonal() * product(k, u);
  return (forces.cwiseAbs().colwise().maxCoeff().array() / (largest * u.cwiseAbs().colwise().maxCoeff()).array())
      .maxCoeff();
}

ReducedMassProperties reduced_mass_properties(const Superelement& body) {
  const Eigen::MatrixXd u = rigid_coordinates(body, body.centre);
  const Eigen::Matrix<double, 6, 6> m = congruent(body.mass, u);
  ReducedMassProperties result;
  result.mass = m.topLeftCorner<3, 3>().trace() / 3;
  // The coupling block is -m d~, with d from the reference to the centre.
  const Eigen::Matrix3d coupling = m.topRightCorner<3, 3>();
  const Eigen::Vector3d offset = Eigen::Vector3d(coupling(1, 2) - coupling(2, 1), coupling(2, 0) - coupling(0, 2),
                                                 coupling(0, 1) - coupling(1, 0)) /
                                 (2 * result.mass);
  result.centre = body.centre + offset;
  result.inertia = m.bottomRightCorner<3, 3>() + result.mass * skew(offset) * skew(offset);
  return result;
}

Eigen::VectorXd free_frequencies(const Superelement& body) {
  return free_modes(body.stiffness, body.mass, rigid_coordinates(body, body.centre)).omega / (2 * std::numbers::pi);
}

std::vector<Check> check_superelement(const Superelement& body) {
  std::vector<Check> checks;
  add_stiffness_checks(body, checks);
  add_mass_checks(body, checks);
  add_recovery_checks(body, checks);
  add_geometric_checks(body, checks);
  return checks;
}

}  // namespace bielle::reduce
