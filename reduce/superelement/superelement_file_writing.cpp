// Writes superelements; superelement_file_reading.cpp reads them. The layout is described in README.md and datasets.md.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/direction_words.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/atomic_output.hpp"
#include "reduce/common/files/byte_sum.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/superelement/adequacy_in_file.hpp"
#include "reduce/superelement/named_points.hpp"
#include "reduce/superelement/physical_check.hpp"
#include "reduce/superelement/superelement.hpp"
#include "reduce/superelement/superelement_file.hpp"
#include "reduce/superelement/superelement_sum.hpp"

namespace bielle {

namespace {

using Integers = std::vector<std::int64_t>;

// `u` are the units of the generalised coordinates.
constexpr const char* stiffness_units = "J/(u_i u_j)";
constexpr const char* damping_units = "J s/(u_i u_j)";
constexpr const char* mass_units = "J s^2/(u_i u_j)";

std::size_t size(Eigen::Index n) { return static_cast<std::size_t>(n); }

/// Matrices one after the other, each row by row.
template <class Matrices>
std::vector<double> flattened(const Matrices& matrices) {
  std::vector<double> values;
  for (const auto& matrix : matrices)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) values.push_back(matrix(i, j));
  return values;
}

void write_interfaces(Hdf5File& file, const Superelement& body) {
  const std::size_t count = body.interfaces.size();
  std::vector<std::string> names;
  Integers kept;
  std::vector<double> positions;
  std::vector<Eigen::Matrix3d> rotations;
  for (const Interface& interface : body.interfaces) {
    names.push_back(interface.name);
    kept.insert(kept.end(), interface.kept.begin(), interface.kept.end());
    positions.insert(positions.end(), interface.position.begin(), interface.position.end());
    rotations.push_back(interface.rotation);
  }
  file.write_names("/interface/names", names);
  file.write("/interface/dofs", kept, {count, 6}, "-", "1: kept; x y z rx ry rz in the interface's axes");
  file.write("/interface/positions", positions, {count, 3}, "m", "in body axes");
  file.write("/interface/rotations", flattened(rotations), {count, 3, 3}, "-", "interface axes -> body axes");
}

void write_coordinates(Hdf5File& file, const Superelement& body) {
  std::vector<std::string> names, units;
  for (const Interface& interface : body.interfaces)
    for (std::size_t k = 0; k < 6; ++k)
      if (interface.kept[k]) {
        names.push_back(fmt::format("{} {}", interface.name, direction_words[k]));
        units.emplace_back(k < 3 ? "m" : "rad");
      }
  const Eigen::Index modes = body.fixed_boundary_modes();
  for (Eigen::Index k = 0; k < body.modes(); ++k) {
    names.push_back(k < modes ? fmt::format("mode {}", k + 1) : fmt::format("residual vector {}", k - modes + 1));
    units.emplace_back("m kg^0.5");
  }
  file.write_names("/reduced/coordinates", names);
  file.write_names("/reduced/coordinate_units", units);
}

void write_reduced(Hdf5File& file, const Superelement& body) {
  const std::size_t n = size(body.size());
  file.write("/reduced/stiffness", body.stiffness, stiffness_units, "u: /reduced/coordinate_units");
  file.write("/reduced/mass", body.mass, mass_units);
  file.write("/reduced/damping", body.damping, damping_units);
  file.write("/reduced/inertia_components", flattened(body.inertia_components), {6, n, n}, mass_units,
             "S_kl = T_k^T m T_l for kl = 11 22 33 23 13 12");
  if (body.spin_stiffness[0].size() > 0)
    file.write("/reduced/geometric_stiffness/spin", flattened(body.spin_stiffness), {6, n, n}, "J/(u_i u_j)/(rad/s)^2",
               "per unit Om_k Om_l for kl = 11 22 33 23 13 12");
  if (!body.load_stiffness.empty())
    file.write("/reduced/geometric_stiffness/load", flattened(body.load_stiffness), {body.load_stiffness.size(), n, n},
               "J/(u_i u_j)/(N or N m)", "per unit load of each kept interface direction");
  if (!body.surface_rotations.empty())
    file.write("/interface/surface_rotations", flattened(body.surface_rotations), {body.surface_rotations.size(), 3, n},
               "rad/u_j", "of each interface's surface, body axes, released rotations included");
  for (const auto& [name, pattern] : body.loads)
    file.write("/loads/" + link_name(name), flattened(pattern.force), {3, 3, n}, "J/u_j",
               "(k, l, j): component k of the pattern acting along body axis l, for a factor of 1");
}

/// Writes the data by which a run judges how far the superelement can be trusted.
void write_judgement(Hdf5File& file, const Superelement& body) {
  if (body.strains.size() > 0)
    file.write("/reduced/strain", body.strains, "1/u_j",
               "xx yy zz yz xz xy of places spread over the body, then the mean over it, body axes");
  if (body.inertia_answer.whole.size() == 0) return;
  constexpr const char* units = "J/(c_i c_j)";
  file.write("/reduced/inertia_answer/whole", body.inertia_answer.whole, units,
             "of the held body's static response to acceleration fields c: direction x y z times 1 x y z");
  file.write("/reduced/inertia_answer/missing", body.inertia_answer.missing, units,
             "part of it that modes and residual vectors do not represent");
}

void write_mesh(Hdf5File& file, const SuperelementMesh& mesh) {
  file.write("/mesh/points", Eigen::MatrixXd(mesh.points.transpose()), "m");
  for (const auto& [type, cells] : mesh.cells) {
    const Integers nodes(cells.data(), cells.data() + cells.size());  // column by column: cell by cell
    file.write(fmt::format("/mesh/cells/{}", type), nodes, {size(cells.cols()), size(cells.rows())}, "-",
               "nodes of each cell, counted from 0, in gmsh's order");
  }
  for (const auto& [name, nodes] : mesh.groups)
    file.write("/mesh/groups/" + link_name(name), Integers(nodes.begin(), nodes.end()), {nodes.size()}, "-",
               "nodes, counted from 0");
}

void write_stress_origin(Hdf5File& file, const StressOrigin& origin) {
  if (origin.materials.empty()) return;
  std::vector<std::string> names;
  std::vector<Eigen::Matrix<double, 6, 6>> elasticities;
  for (const StressMaterial& material : origin.materials) {
    names.push_back(material.name);
    elasticities.push_back(material.elasticity);
  }
  file.write_names("/recovery/materials", names);
  file.write("/recovery/elasticity", flattened(elasticities), {names.size(), 6, 6}, "Pa",
             "of each material; stress over engineering strain, body axes");
  const Integers material_of(origin.material_of.begin(), origin.material_of.end());
  file.write("/recovery/stress_materials", material_of, {material_of.size()}, "-",
             "of each of /recovery/stress_nodes: number in /recovery/materials, from 0");
  for (const auto& [name, rows] : origin.groups)
    file.write("/recovery/stress_groups/" + link_name(name), Integers(rows.begin(), rows.end()), {rows.size()}, "-",
               "places in /recovery/stress_nodes, from 0, whose stress is that of this volume");
}

void write_recovery(Hdf5File& file, const Superelement& body) {
  if (body.displacement_recovery.size() > 0)
    file.write("/recovery/displacement", body.displacement_recovery, "m/u_j", "x y z of node 0, of node 1, ...");
  if (body.stress_recovery.size() > 0) {
    file.write("/recovery/stress", body.stress_recovery, "Pa/u_j",
               "xx yy zz yz xz xy of each of /recovery/stress_nodes");
    const Integers nodes(body.stress_nodes.begin(), body.stress_nodes.end());
    file.write("/recovery/stress_nodes", nodes, {nodes.size()}, "-", "nodes of the mesh, counted from 0");
    write_stress_origin(file, body.stress_origin);
  }
}

void write_all(Hdf5File& file, const Superelement& body) {
  file.write_attribute("/", "format", std::string(superelement_format));
  file.write_attribute("/", "version", std::int64_t{superelement_version});
  file.write_attribute("/", "name", body.name);
  file.write_attribute("/", "created_by", body.created_by);
  file.write_attribute("/", "complete", std::int64_t{0});
  file.write_text("/input", body.input);
  write_interfaces(file, body);
  write_coordinates(file, body);
  write_reduced(file, body);
  file.write("/modes/frequencies", body.frequencies, "Hz", "of the modes with all interfaces fixed");
  if (body.residual_vectors > 0)
    file.write_attribute("/modes", "residual_vectors", std::int64_t{body.residual_vectors});
  file.write("/modes/effective_mass", body.effective_mass, "kg, kg m^2",
             "x y z [kg], rx ry rz about the centre of mass [kg m^2]");
  if (body.mode_turns.size() > 0)
    file.write("/modes/turns", body.mode_turns, "rad/u_j", "rotation x y z of places spread over the body, body axes");
  write_judgement(file, body);
  file.write("/mass_properties/mass", body.total_mass, "kg");
  file.write("/mass_properties/centre", Eigen::VectorXd(body.centre), "m");
  file.write("/mass_properties/inertia", Eigen::MatrixXd(body.inertia), "kg m^2", "about the centre, body axes");
  write_named_points(body.points, file);
  write_mesh(file, body.mesh);
  write_recovery(file, body);
  write_quantities(body.quantities, file);
  for (const auto& [name, value] : body.checks) file.write("/checks/" + link_name(name), value, "SI");
  if (body.adequacy) write_adequacy(*body.adequacy, file);
  file.write_attribute("/", "checksum", sum_of(body));
  file.write_attribute("/", "complete", std::int64_t{1});
}

}  // namespace

void check_writable(const Superelement& superelement, const std::string& path) {
  const std::string fault = first_fault_of(superelement);
  if (!fault.empty()) throw ComputationError(fmt::format("{}: not written, since {}", path, fault));
}

void write_superelement(const Superelement& superelement, Hdf5File& file) { write_all(file, superelement); }

void write_superelement(const Superelement& superelement, const std::string& path) {
  check_writable(superelement, path);
  AtomicOutput output(path);
  Hdf5File file = Hdf5File::create(output.temporary_path());
  write_superelement(superelement, file);
  file.close();
  append_byte_sum(output.temporary_path());
  output.commit();
}

}  // namespace bielle
