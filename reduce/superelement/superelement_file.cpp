#include "reduce/superelement/superelement_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "reduce/common/direction_words.hpp"
#include "reduce/common/files/atomic_output.hpp"
#include "reduce/common/files/byte_sum.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/files/hdf5_soundness.hpp"
#include "reduce/superelement/adequacy_in_file.hpp"
#include "reduce/superelement/named_points.hpp"
#include "reduce/superelement/physical_check.hpp"
#include "reduce/superelement/superelement.hpp"
#include "reduce/superelement/superelement_check.hpp"
#include "reduce/superelement/superelement_sum.hpp"

namespace bielle {

namespace {

using Integers = std::vector<std::int64_t>;
constexpr const char* format_name = "bielle superelement";

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

Eigen::MatrixXd matrix_at(const std::vector<double>& values, std::size_t k, Eigen::Index rows, Eigen::Index columns) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(values.data() + k * size(rows * columns), rows, columns);
}

// -- writing

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
             "of the held body's static answer to acceleration fields c: direction x y z times 1 x y z");
  file.write("/reduced/inertia_answer/missing", body.inertia_answer.missing, units,
             "of that what modes and residual vectors have not");
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
  file.write_attribute("/", "format", std::string(format_name));
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

// -- reading

/// Reads datasets of expected shapes. Each message about a fault contains its remedy.
class Reader {
 public:
  explicit Reader(const Hdf5File& file) : file_(file) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", file_.place(), what));
  }
  std::vector<double> numbers(const std::string& dataset, const Shape& expected) const {
    check_shape(dataset, expected);
    return file_.read(dataset);
  }
  Integers integers(const std::string& dataset, const Shape& expected) const {
    check_shape(dataset, expected);
    return file_.read_integers(dataset);
  }
  template <class Matrices>
  void matrices(const std::string& dataset, Matrices& result, std::size_t rows, std::size_t columns) const {
    const std::vector<double> values = numbers(dataset, {result.size(), rows, columns});
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] = matrix_at(values, k, static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  }
  std::vector<std::string> members(const std::string& group) const {
    return file_.has(group) ? file_.names_in(group) : std::vector<std::string>{};
  }
  std::vector<int> nodes(const std::string& dataset) const {
    const Integers values = file_.read_integers(dataset);
    return {values.begin(), values.end()};
  }

 private:
  void check_shape(const std::string& dataset, const Shape& expected) const {
    const Shape found = file_.shape(dataset);
    if (found != expected)
      fail(fmt::format("{}: expected the shape ({}), found ({})", dataset, fmt::join(expected, ", "),
                       fmt::join(found, ", ")));
  }
  const Hdf5File& file_;
};

void check_head(const Hdf5File& file, const Reader& reader) {
  if (!file.has_attribute("/", "format") || file.read_text_attribute("/", "format") != format_name)
    reader.fail("is no superelement of bielle-reduce");
  const std::int64_t version = file.read_integer_attribute("/", "version");
  if (version != superelement_version)
    reader.fail(
        fmt::format("has version {} of the file format, but this program reads version {}; run bielle-reduce again",
                    version, superelement_version));
  if (file.read_integer_attribute("/", "complete") != 1) reader.fail("was never completed; run bielle-reduce again");
}

void read_interfaces(const Hdf5File& file, const Reader& reader, Superelement& body) {
  const std::vector<std::string> names = file.read_names("/interface/names");
  const std::size_t count = names.size();
  const Integers kept = reader.integers("/interface/dofs", {count, 6});
  const std::vector<double> positions = reader.numbers("/interface/positions", {count, 3});
  std::vector<Eigen::Matrix3d> rotations(count);
  reader.matrices("/interface/rotations", rotations, 3, 3);
  for (std::size_t i = 0; i < count; ++i) {
    Interface interface;
    interface.name = names[i];
    interface.position = Eigen::Vector3d(&positions[3 * i]);
    interface.rotation = rotations[i];
    for (std::size_t k = 0; k < 6; ++k) {
      if (kept[6 * i + k] != 0 && kept[6 * i + k] != 1) reader.fail("/interface/dofs: expected 0 or 1");
      interface.kept[k] = kept[6 * i + k] == 1;
    }
    body.interfaces.push_back(interface);
  }
}

void read_reduced(const Hdf5File& file, const Reader& reader, Superelement& body) {
  body.stiffness = file.read_matrix("/reduced/stiffness");
  body.mass = file.read_matrix("/reduced/mass");
  body.damping = file.read_matrix("/reduced/damping");
  const std::size_t n = size(body.size());
  reader.matrices("/reduced/inertia_components", body.inertia_components, n, n);
  if (file.has("/reduced/geometric_stiffness/spin"))
    reader.matrices("/reduced/geometric_stiffness/spin", body.spin_stiffness, n, n);
  if (file.has("/reduced/geometric_stiffness/load")) {
    const Shape shape = file.shape("/reduced/geometric_stiffness/load");
    body.load_stiffness.resize(shape.empty() ? 0 : shape[0]);
    reader.matrices("/reduced/geometric_stiffness/load", body.load_stiffness, n, n);
  }
  for (const std::string& link : reader.members("/loads")) {
    const std::vector<double> values = reader.numbers("/loads/" + link, {3, 3, n});
    LoadPattern& pattern = body.loads[name_of_link(link)];
    for (std::size_t k = 0; k < 3; ++k) pattern.force[k] = matrix_at(values, k, 3, body.size());
  }
}

void read_mass_properties(const Hdf5File& file, const Reader& reader, Superelement& body) {
  body.total_mass = file.read_number("/mass_properties/mass");
  body.centre = Eigen::Vector3d(reader.numbers("/mass_properties/centre", {3}).data());
  body.inertia = matrix_at(reader.numbers("/mass_properties/inertia", {3, 3}), 0, 3, 3);
}

void read_mesh(const Hdf5File& file, const Reader& reader, SuperelementMesh& mesh) {
  const Eigen::MatrixXd points = file.read_matrix("/mesh/points");
  if (points.cols() != 3) reader.fail("/mesh/points: expected three columns");
  mesh.points = points.transpose();
  for (const std::string& type : reader.members("/mesh/cells")) {
    const std::string dataset = "/mesh/cells/" + type;
    const Shape shape = file.shape(dataset);
    int number = 0;
    if (shape.size() != 2 ||
        std::from_chars(type.data(), type.data() + type.size(), number).ptr != type.data() + type.size())
      reader.fail(dataset + ": expected cells x nodes under the number of a gmsh element type");
    const std::vector<int> nodes = reader.nodes(dataset);
    mesh.cells[number] = Eigen::Map<const Eigen::MatrixXi>(nodes.data(), static_cast<Eigen::Index>(shape[1]),
                                                           static_cast<Eigen::Index>(shape[0]));
  }
  for (const std::string& link : reader.members("/mesh/groups"))
    mesh.groups[name_of_link(link)] = reader.nodes("/mesh/groups/" + link);
}

/// These data are optional: older files and files of other programs have none.
void read_stress_origin(const Hdf5File& file, const Reader& reader, StressOrigin& origin) {
  if (!file.has("/recovery/materials")) return;
  const std::vector<std::string> names = file.read_names("/recovery/materials");
  std::vector<Eigen::MatrixXd> elasticities(names.size());
  reader.matrices("/recovery/elasticity", elasticities, 6, 6);
  for (std::size_t k = 0; k < names.size(); ++k) origin.materials.push_back({names[k], elasticities[k]});
  origin.material_of = reader.nodes("/recovery/stress_materials");
  for (const std::string& link : reader.members("/recovery/stress_groups"))
    origin.groups[name_of_link(link)] = reader.nodes("/recovery/stress_groups/" + link);
}

/// Files of other programs have no checksum.
void check_sum(const Hdf5File& file, const Reader& reader, const Superelement& body) {
  if (!file.has_attribute("/", "checksum")) return;
  std::optional<std::int64_t> sum;
  try {
    sum = file.read_integer_attribute("/", "checksum");
  } catch (const InputError&) {
    // Another program has written something else under this name.
  }
  if (!sum)
    reader.fail(
        "the attribute 'checksum' is no whole number: it is none of bielle-reduce, whose sums are. A file of another "
        "program goes without it, or has its own sum under another name");
  if (*sum == sum_of(body)) return;
  reader.fail(
      "its numbers are not those that were written: it is damaged, was changed, or has points of an earlier version; "
      "run bielle-reduce again (who changes numbers on purpose removes the attribute 'checksum')");
}

/// Faults of single parts are reported first.
std::string first_fault(const Superelement& body) {
  const std::string fault = fault_of(body);
  return fault.empty() ? physical_fault_of(body) : fault;
}

}  // namespace

void check_writable(const Superelement& superelement, const std::string& path) {
  const std::string fault = first_fault(superelement);
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

Superelement read_superelement(const SuperelementPlace& place) {
  Hdf5File file = Hdf5File::open(place.path);
  file.enter(place.group);
  return read_superelement(file);
}

namespace {

void read_head(const Hdf5File& file, Superelement& body) {
  body.name = file.read_text_attribute("/", "name");
  body.created_by = file.read_text_attribute("/", "created_by");
}

/// Reads the parts that a mechanism needs in every run.
void read_parts_of_motion(const Hdf5File& file, const Reader& reader, Superelement& body) {
  body.frequencies = file.read_vector("/modes/frequencies");
  if (file.has_attribute("/modes", "residual_vectors"))
    body.residual_vectors = file.read_integer_attribute("/modes", "residual_vectors");
  body.effective_mass = file.read_matrix("/modes/effective_mass");
  if (file.has("/modes/turns")) body.mode_turns = file.read_matrix("/modes/turns");
  if (file.has("/reduced/strain")) body.strains = file.read_matrix("/reduced/strain");
  if (file.has("/reduced/inertia_answer/whole")) {
    body.inertia_answer.whole = file.read_matrix("/reduced/inertia_answer/whole");
    body.inertia_answer.missing = file.read_matrix("/reduced/inertia_answer/missing");
  }
  read_interfaces(file, reader, body);
  read_reduced(file, reader, body);
  read_mass_properties(file, reader, body);
}

}  // namespace

Superelement read_superelement(const Hdf5File& file) {
  const Reader reader(file);
  check_head(file, reader);
  Superelement body;
  read_head(file, body);
  body.input = file.read_text("/input");
  read_parts_of_motion(file, reader, body);
  if (file.has("/interface/surface_rotations")) {
    body.surface_rotations.resize(body.interfaces.size());
    reader.matrices("/interface/surface_rotations", body.surface_rotations, 3, size(body.size()));
  }
  body.points = read_named_points(file);
  read_mesh(file, reader, body.mesh);
  if (file.has("/recovery/displacement")) body.displacement_recovery = file.read_matrix("/recovery/displacement");
  if (file.has("/recovery/stress")) {
    body.stress_recovery = file.read_matrix("/recovery/stress");
    body.stress_nodes = reader.nodes("/recovery/stress_nodes");
    read_stress_origin(file, reader, body.stress_origin);
  }
  body.quantities = read_quantities(file);
  for (const std::string& link : reader.members("/checks"))
    body.checks[name_of_link(link)] = file.read_number("/checks/" + link);
  body.adequacy = read_adequacy(file);
  if (const std::string fault = first_fault(body); !fault.empty()) reader.fail(fault);
  check_sum(file, reader, body);
  return body;
}

Superelement read_parts_of_motion(const Hdf5File& file) {
  if (!is_as_written(file.path())) return read_superelement(file);
  const Reader reader(file);
  check_head(file, reader);
  Superelement body;
  read_head(file, body);
  read_parts_of_motion(file, reader, body);
  if (const std::string fault = fault_of(body); !fault.empty()) reader.fail(fault);
  return body;
}

}  // namespace bielle
