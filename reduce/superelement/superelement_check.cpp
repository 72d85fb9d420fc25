#include "reduce/superelement/superelement_check.hpp"

#include <cmath>
#include <set>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle {

namespace {

using Eigen::Index;

/// The first fault ends the check.
struct Fault {
  std::string message;
};

/// Throws if a condition is not satisfied. The message is formatted only then, because some conditions are checked for
/// each entry of a matrix.
template <class... Values>
void require(bool condition, const std::string& dataset, fmt::format_string<const Values&...> message,
             const Values&... values) {
  if (!condition) throw Fault{dataset + ": " + fmt::format(message, values...)};
}

template <class Matrix>
void check_matrix(const Matrix& matrix, Index rows, Index columns, const std::string& dataset) {
  require(matrix.rows() == rows && matrix.cols() == columns, dataset, "expected {} x {} numbers, found {} x {}", rows,
          columns, matrix.rows(), matrix.cols());
  require(matrix.allFinite(), dataset, "holds numbers that are not finite");
}

/// Checks that |a_ij - a_ji| <= 1e-8 sqrt(|a_ii a_jj|): a bound that does not depend on the units of the coordinates.
/// The reduction writes symmetric matrices; those in files of other programs may differ by rounding.
void check_symmetric(const Eigen::MatrixXd& matrix, const std::string& dataset) {
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < i; ++j)
      require(std::abs(matrix(i, j) - matrix(j, i)) <= 1e-8 * std::sqrt(std::abs(matrix(i, i) * matrix(j, j))), dataset,
              "is not symmetric: entries ({0}, {1}) and ({1}, {0}) are {2} and {3}", i + 1, j + 1, matrix(i, j),
              matrix(j, i));
}

void check_interfaces(const Superelement& body) {
  std::set<std::string> names;
  for (const Interface& interface : body.interfaces) {
    require(!interface.name.empty(), "/interface/names", "an interface has no name");
    require(names.insert(interface.name).second, "/interface/names", "the name '{}' stands there twice",
            interface.name);
    require(interface.position.allFinite(), "/interface/positions", "holds numbers that are not finite");
    const Eigen::Matrix3d& R = interface.rotation;
    require((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-9 && R.determinant() > 0,
            "/interface/rotations", "that of '{}' is no rotation matrix", interface.name);
  }
}

void check_reduced(const Superelement& body) {
  const Index n = body.size(), m = body.modes();
  Index directions = 0;
  for (const Interface& interface : body.interfaces)
    for (const bool kept : interface.kept) directions += kept ? 1 : 0;
  require(directions + m == n, "/reduced/stiffness", "expected {} for {} and {}, found {}",
          counted(directions + m, "row"), counted(directions, "interface direction"), counted(m, "mode"), n);
  check_matrix(body.stiffness, n, n, "/reduced/stiffness");
  check_matrix(body.mass, n, n, "/reduced/mass");
  check_matrix(body.damping, n, n, "/reduced/damping");
  check_symmetric(body.stiffness, "/reduced/stiffness");
  check_symmetric(body.mass, "/reduced/mass");
  check_symmetric(body.damping, "/reduced/damping");
  for (std::size_t k = 0; k < 6; ++k) {
    check_matrix(body.inertia_components[k], n, n, "/reduced/inertia_components");
    if (k < 3) check_symmetric(body.inertia_components[k], "/reduced/inertia_components");
    const Index spin = body.spin_stiffness[0].size() == 0 ? 0 : n;
    check_matrix(body.spin_stiffness[k], spin, spin, "/reduced/geometric_stiffness/spin");
    check_symmetric(body.spin_stiffness[k], "/reduced/geometric_stiffness/spin");
  }
  require(body.load_stiffness.empty() || static_cast<Index>(body.load_stiffness.size()) == directions,
          "/reduced/geometric_stiffness/load", "expected {}, found {}", counted(directions, "matrix", "matrices"),
          body.load_stiffness.size());
  for (const Eigen::MatrixXd& stiffness : body.load_stiffness) {
    check_matrix(stiffness, n, n, "/reduced/geometric_stiffness/load");
    check_symmetric(stiffness, "/reduced/geometric_stiffness/load");
  }
  require(body.surface_rotations.empty() || body.surface_rotations.size() == body.interfaces.size(),
          "/interface/surface_rotations", "expected {}, found {}",
          counted(body.interfaces.size(), "matrix", "matrices"), body.surface_rotations.size());
  for (const Eigen::MatrixXd& rotation : body.surface_rotations)
    check_matrix(rotation, 3, n, "/interface/surface_rotations");
  check_matrix(body.frequencies, m, 1, "/modes/frequencies");
  require(m == 0 || body.frequencies.minCoeff() >= 0, "/modes/frequencies", "holds negative numbers");
  require(body.residual_vectors >= 0 && body.residual_vectors <= m, "/modes", "of {}, {} cannot be residual vectors",
          counted(m, "mode"), body.residual_vectors);
  check_matrix(body.effective_mass, m, 6, "/modes/effective_mass");
  if (body.mode_turns.size() > 0) check_matrix(body.mode_turns, body.mode_turns.rows() / 3 * 3, m, "/modes/turns");
  if (body.strains.size() > 0) check_matrix(body.strains, body.strains.rows() / 6 * 6, n, "/reduced/strain");
  if (const InertiaAnswer& answer = body.inertia_answer; answer.whole.size() + answer.missing.size() > 0) {
    check_matrix(answer.whole, 12, 12, "/reduced/inertia_answer/whole");
    check_matrix(answer.missing, 12, 12, "/reduced/inertia_answer/missing");
  }
  for (const auto& [name, pattern] : body.loads)
    for (const Eigen::Matrix3Xd& force : pattern.force) check_matrix(force, 3, n, "/loads/" + name);
  for (const auto& [name, point] : body.points) {
    require(point.position.allFinite(), "/points/" + name + "/position", "holds numbers that are not finite");
    check_matrix(point.shapes, 6, n, "/points/" + name + "/shapes");
  }
}

void check_mass_properties(const Superelement& body) {
  require(std::isfinite(body.total_mass) && body.total_mass > 0, "/mass_properties/mass",
          "expected a positive number, found {}", body.total_mass);
  require(body.centre.allFinite(), "/mass_properties/centre", "holds numbers that are not finite");
  check_matrix(body.inertia, 3, 3, "/mass_properties/inertia");
  check_symmetric(body.inertia, "/mass_properties/inertia");
}

void check_mesh(const Superelement& body) {
  const Index points = body.mesh.points.cols();
  const auto is_node = [&](Index node) { return node >= 0 && node < points; };
  require(body.mesh.points.allFinite(), "/mesh/points", "holds numbers that are not finite");
  for (const auto& [type, cells] : body.mesh.cells)
    require(cells.size() == 0 || (is_node(cells.minCoeff()) && is_node(cells.maxCoeff())),
            fmt::format("/mesh/cells/{}", type), "names nodes that are not in the mesh");
  for (const auto& [name, nodes] : body.mesh.groups)
    for (const int node : nodes) require(is_node(node), "/mesh/groups/" + name, "names nodes that are not in the mesh");
  for (const int node : body.stress_nodes)
    require(is_node(node), "/recovery/stress_nodes", "names nodes that are not in the mesh");
  if (body.displacement_recovery.size() > 0)
    check_matrix(body.displacement_recovery, 3 * points, body.size(), "/recovery/displacement");
  const auto stresses = static_cast<Index>(6 * body.stress_nodes.size());
  if (body.stress_recovery.size() > 0 || stresses > 0)
    check_matrix(body.stress_recovery, stresses, body.size(), "/recovery/stress");
}

void check_stress_origin(const Superelement& body) {
  const StressOrigin& origin = body.stress_origin;
  if (origin.materials.empty()) return;
  const auto stressed = static_cast<int>(body.stress_nodes.size());
  const auto materials = static_cast<int>(origin.materials.size());
  for (const StressMaterial& material : origin.materials) {
    const Eigen::MatrixXd elasticity = material.elasticity;
    check_matrix(elasticity, 6, 6, "/recovery/elasticity");
    check_symmetric(elasticity, "/recovery/elasticity");
    require(elasticity.determinant() > 0, "/recovery/elasticity", "that of '{}' does not resist every strain",
            material.name);
  }
  require(static_cast<int>(origin.material_of.size()) == stressed, "/recovery/stress_materials",
          "expected one for each of {}, found {}", counted(stressed, "stress node"), origin.material_of.size());
  for (const int material : origin.material_of)
    require(material >= 0 && material < materials, "/recovery/stress_materials",
            "names materials that are not in /recovery/materials");
  for (const auto& [name, rows] : origin.groups)
    for (const int row : rows)
      require(row >= 0 && row < stressed, "/recovery/stress_groups/" + name,
              "names places that are not in /recovery/stress_nodes");
}

}  // namespace

std::string fault_of(const Superelement& superelement) {
  try {
    check_interfaces(superelement);
    check_reduced(superelement);
    check_mass_properties(superelement);
    check_mesh(superelement);
    check_stress_origin(superelement);
    if (std::string fault = fault_of(superelement.quantities, superelement.size()); !fault.empty())
      throw Fault{std::move(fault)};
  } catch (const Fault& fault) {
    return fault.message;
  }
  return "";
}

}  // namespace bielle
