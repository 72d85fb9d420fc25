#include "reduce/reduction/geometric_checks.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "reduce/dense/dense_products.hpp"
#include "reduce/reduction/free_body.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

/// Returns the contribution of the coordinates of interfaces that release one rotation to the energy of rigid
/// rotations, for each kept direction: -(d w^T + w d^T) / 2, w = m x d, see tie_second_order.hpp.
std::vector<Eigen::Matrix3d> released_rotations(const std::vector<Interface>& interfaces) {
  std::vector<Eigen::Matrix3d> result;
  for (const Interface& interface : interfaces) {
    const bool tilts = std::count(interface.kept.begin() + 3, interface.kept.end(), true) == 2;
    const auto released =
        std::find(interface.kept.begin() + 3, interface.kept.end(), false) - interface.kept.begin() - 3;
    for (int axis = 0; axis < 6; ++axis) {
      if (!interface.kept[axis]) {
        continue;
      }
      result.emplace_back(Eigen::Matrix3d::Zero());
      if (tilts && axis >= 3) {
        const Eigen::Vector3d d = interface.rotation.col(released);
        const Eigen::Vector3d w = interface.rotation.col(axis - 3).cross(d);
        result.back() = -(d * w.transpose() + w * d.transpose()) / 2;
      }
    }
  }
  return result;
}

/// Adds the rows of the change of an interface's coordinates when the body turns by a, in terms of the coordinates
/// (kept directions, n): a x u for the displacement, and the change of the mechanism's coordinates for the rotation.
void add_turned_rows(const Interface& interface, const Eigen::MatrixXd& rotation, Eigen::Index first,
                     const Eigen::Vector3d& a, Eigen::MatrixXd& turned) {
  const auto rotations = std::count(interface.kept.begin() + 3, interface.kept.end(), true);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3, turned.cols());
  Eigen::Index row = first;
  for (int axis = 0; axis < 3; ++axis) {
    if (interface.kept[axis]) {
      u += interface.rotation.col(axis) * Eigen::RowVectorXd::Unit(turned.cols(), row++);
    }
  }
  Eigen::MatrixXd theta = skew(a) * rotation / 2;
  if (rotations == 2) {
    const auto released =
        std::find(interface.kept.begin() + 3, interface.kept.end(), false) - interface.kept.begin() - 3;
    const Eigen::Vector3d d = interface.rotation.col(released);
    theta = a.dot(d) * skew(d) * rotation;
  }
  row = first;
  for (int axis = 0; axis < 6; ++axis) {
    if (interface.kept[axis]) {
      turned.row(row++) = interface.rotation.col(axis % 3).transpose() * (axis < 3 ? skew(a) * u : theta);
    }
  }
}

/// Adds a check of objectivity. The elastic energy in linear coordinates eps, q = eps - g(eps),
/// g_j = eps^T K_j eps / 2, must not depend on which of two close frames describes the body:
/// sym[K~ (W_a + N_a)] = 0 for all a, with W_a the rows above and N_a the rows (K_j U a)^T.
void add_objectivity_check(const Superelement& body, std::vector<Check>& checks) {
  const bool whole = std::all_of(body.interfaces.begin(), body.interfaces.end(), [](const Interface& interface) {
    const auto kept = std::count(interface.kept.begin(), interface.kept.begin() + 3, true);
    return kept == 0 || kept == 3;  // a node that slides along a direction of the body turns with it
  });
  if (body.load_stiffness.empty() || body.surface_rotations.empty() || !whole) {
    return;
  }
  const Eigen::MatrixXd u = rigid_coordinates(body, body.centre).rightCols<3>();
  const Eigen::VectorXd scale = body.mass.diagonal().cwiseSqrt().cwiseInverse();
  double error = 0, size = 0;
  for (int k = 0; k < 3; ++k) {
    Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(body.size(), body.size());
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
      const Interface& interface = body.interfaces[i];
      add_turned_rows(interface, body.surface_rotations[i], row, Eigen::Vector3d::Unit(k), turned);
      row += std::count(interface.kept.begin(), interface.kept.end(), true);
    }
    const auto in_unit_mass = [&](const Eigen::MatrixXd& x) {
      const Eigen::MatrixXd energy = scale.asDiagonal() * product(body.stiffness, x) * scale.asDiagonal();
      return (energy + energy.transpose()).cwiseAbs().maxCoeff();
    };
    size = std::max(size, in_unit_mass(turned));
    for (std::size_t j = 0; j < body.load_stiffness.size(); ++j) {
      turned.row(static_cast<Eigen::Index>(j)) += (body.load_stiffness[j] * u.col(k)).transpose();
    }
    error = std::max(error, in_unit_mass(turned));
  }
  checks.push_back({"load_stiffness_objectivity", size > 0 ? error / size : 0, 1e-6,
                    "what loads do to its stiffness does not depend on the frame"});
}

/// Checks the energy of the geometric stiffness in rigid translations (zero) and rotations: tr(Q) I - sym(Q).
void add_virial_checks(const Superelement& body, std::vector<Check>& checks) {
  if (body.spin_stiffness[0].size() == 0) {
    return;
  }
  const Eigen::MatrixXd u = rigid_coordinates(body, body.centre);
  const std::vector<Eigen::Matrix3d> virial = virials(body.interfaces, mass_properties(body));
  const std::vector<Eigen::Matrix3d> release_terms = released_rotations(body.interfaces);
  const double length = radius_of_gyration(mass_properties(body));
  double spin = 0, load = 0;
  for (std::size_t field = 0; field < 6 + body.load_stiffness.size(); ++field) {
    const bool is_spin = field < 6;
    const Eigen::MatrixXd& k = is_spin ? body.spin_stiffness[field] : body.load_stiffness[field - 6];
    const Eigen::Matrix3d& q = virial[field];
    Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
    expected.bottomRightCorner<3, 3>() = q.trace() * Eigen::Matrix3d::Identity() - (q + q.transpose()) / 2;
    if (!is_spin) {
      expected.bottomRightCorner<3, 3>() += release_terms[field - 6];
    }
    Eigen::Matrix<double, 6, 6> error = congruent(k, u) - expected;
    error.topRows<3>() *= length;
    error.leftCols<3>() *= length;
    // Errors are relative to the effect of such a load on a body of this size: m l^2 for spins, l for forces, 1 for
    // moments.
    const double unit = is_spin ? body.total_mass * length * length : std::max(1.0, length);
    (is_spin ? spin : load) = std::max(is_spin ? spin : load, error.cwiseAbs().maxCoeff() / unit);
  }
  checks.push_back(
      {"spin_stiffness_virial", spin, 1e-6, "turned as a whole, the spinning body does the work of its inertia"});
  if (!body.load_stiffness.empty()) {
    checks.push_back(
        {"load_stiffness_virial", load, 1e-6, "turned as a whole, the loaded body does the work of its loads"});
  }
}

}  // namespace

void add_geometric_checks(const Superelement& body, std::vector<Check>& checks) {
  add_virial_checks(body, checks);
  add_objectivity_check(body, checks);
}

}  // namespace bielle::reduce
