// Reads superelements; superelement_file_writing.cpp writes them. The layout is described in README.md and datasets.md.
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/files/hdf5_soundness.hpp"
#include "reduce/superelement/adequacy_in_file.hpp"
#include "reduce/superelement/named_points.hpp"
#include "reduce/superelement/physical_check.hpp"
#include "reduce/superelement/superelement.hpp"
#include "reduce/superelement/superelement_check.hpp"
#include "reduce/superelement/superelement_file.hpp"
#include "reduce/superelement/superelement_sum.hpp"

namespace bielle {

namespace {

using Integers = std::vector<std::int64_t>;

Eigen::MatrixXd matrix_at(const std::vector<double>& values, std::size_t k, Eigen::Index rows, Eigen::Index columns) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(values.data() + k * static_cast<std::size_t>(rows * columns), rows, columns);
}

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
  if (!file.has_attribute("/", "format") || file.read_text_attribute("/", "format") != superelement_format)
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
  const auto n = static_cast<std::size_t>(body.size());
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

/// Reads data that are optional: older files and files of other programs have none.
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

/// Checks the checksum, which files of other programs do not have.
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
        "the attribute 'checksum' is no whole number, so that bielle-reduce has not written it. A file of another "
        "program leaves it out, or has its own sum under another name");
  if (*sum == sum_of(body)) return;
  reader.fail(
      "its numbers are not those that were written: it is damaged, was changed, or has points of an earlier version; "
      "run bielle-reduce again (after a change on purpose, remove the attribute 'checksum')");
}

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

Superelement read_superelement(const SuperelementPlace& place) {
  Hdf5File file = Hdf5File::open(place.path);
  file.enter(place.group);
  return read_superelement(file);
}

Superelement read_superelement(const Hdf5File& file) {
  const Reader reader(file);
  check_head(file, reader);
  Superelement body;
  read_head(file, body);
  body.input = file.read_text("/input");
  read_parts_of_motion(file, reader, body);
  if (file.has("/interface/surface_rotations")) {
    body.surface_rotations.resize(body.interfaces.size());
    reader.matrices("/interface/surface_rotations", body.surface_rotations, 3, static_cast<std::size_t>(body.size()));
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
  if (const std::string fault = first_fault_of(body); !fault.empty()) reader.fail(fault);
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
