#include <algorithm>
#include <charconv>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/matrices/matrix_set.hpp"

namespace bielle::reduce {

namespace {

constexpr const char* format_of_matrices = "bielle matrices";
constexpr std::int64_t version_of_matrices = 1;

using Integers = std::vector<std::int64_t>;

[[noreturn]] void refuse_matrices(const Hdf5File& file, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", file.path(), reason));
}

bool is_matrix_file(const Hdf5File& file) {
  return file.has_attribute("/", "format") && file.read_text_attribute("/", "format") == format_of_matrices;
}

void require_shape(const Hdf5File& file, const std::string& dataset, const Shape& expected) {
  if (file.shape(dataset) != expected)
    refuse_matrices(file, fmt::format("{} has not the shape that belongs to the unknowns and nodes", dataset));
}

std::vector<double> finite_numbers(const Hdf5File& file, const std::string& dataset) {
  std::vector<double> values = file.read(dataset);
  constexpr double largest = 1e100;  // products of two such numbers are finite
  for (const double x : values)
    if (!(std::abs(x) <= largest))
      refuse_matrices(file, fmt::format("{} holds the number {:g}: expected numbers within {:g}", dataset, x, largest));
  return values;
}

/// Reads columns of three numbers, from rows of three.
Eigen::Matrix3Xd columns_of_three(const Hdf5File& file, const std::string& dataset, std::size_t rows) {
  require_shape(file, dataset, {rows, 3});
  const std::vector<double> values = finite_numbers(file, dataset);
  return Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, static_cast<Eigen::Index>(rows));
}

std::vector<Eigen::Matrix3d> tensors(const Hdf5File& file, const std::string& dataset, std::size_t count) {
  require_shape(file, dataset, {count, 3, 3});
  const std::vector<double> values = finite_numbers(file, dataset);
  std::vector<Eigen::Matrix3d> result;
  for (std::size_t k = 0; k < count; ++k)
    result.emplace_back(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data() + 9 * k));
  return result;
}

Eigen::MatrixXd matrix_of(const Hdf5File& file, const std::string& dataset, std::size_t rows, std::size_t columns) {
  require_shape(file, dataset, {rows, columns});
  finite_numbers(file, dataset);
  return file.read_matrix(dataset);
}

void read_nodes(const Hdf5File& file, MatrixSet& set) {
  set.numbers = file.read_integers("/nodes/numbers");
  const std::size_t nodes = set.numbers.size();
  set.positions = nodes > 0 ? columns_of_three(file, "/nodes/positions", nodes) : Eigen::Matrix3Xd(3, 0);
  set.axes.assign(nodes, Eigen::Matrix3d::Identity());
  if (nodes == 0 || !file.has("/nodes/axes")) return;
  set.axes = tensors(file, "/nodes/axes", nodes);
  for (std::size_t a = 0; a < nodes; ++a)
    if (!((set.axes[a].transpose() * set.axes[a] - Eigen::Matrix3d::Identity()).norm() < 1e-6) ||
        set.axes[a].determinant() < 0)
      refuse_matrices(file, fmt::format("the axes of node {} are no rotation", set.numbers[a]));
}

void read_unknowns(const Hdf5File& file, MatrixSet& set) {
  const Integers nodes = file.read_integers("/unknowns/nodes"), components = file.read_integers("/unknowns/components");
  if (nodes.empty()) refuse_matrices(file, "holds no unknowns");
  if (nodes.size() != components.size())
    refuse_matrices(file, "/unknowns/nodes and /unknowns/components differ in size");
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const bool is_scalar = nodes[k] == -1;
    if (!is_scalar && (nodes[k] < 0 || nodes[k] >= static_cast<std::int64_t>(set.numbers.size())))
      refuse_matrices(file, fmt::format("/unknowns/nodes: {} is no node", nodes[k]));
    if (components[k] < 0 || (!is_scalar && components[k] > 5))
      refuse_matrices(file, fmt::format("/unknowns/components: {} is no component", components[k]));
    set.unknowns.push_back({static_cast<int>(nodes[k]), static_cast<int>(components[k])});
  }
}

SparseColumns read_sparse(const Hdf5File& file, const std::string& group, Eigen::Index n) {
  const Integers rows = file.read_integers(group + "/rows"), columns = file.read_integers(group + "/columns");
  const std::vector<double> values = finite_numbers(file, group + "/values");
  if (rows.size() != values.size() || columns.size() != values.size())
    refuse_matrices(file, fmt::format("{}: rows, columns and values differ in size", group));
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (rows[k] < 0 || rows[k] >= n || columns[k] < 0 || columns[k] >= n)
      refuse_matrices(file, fmt::format("{}: entry ({}, {}) is outside a matrix of {}", group, rows[k], columns[k],
                                        counted(n, "unknown")));
    entries.emplace_back(static_cast<int>(rows[k]), static_cast<int>(columns[k]), values[k]);
  }
  SparseColumns result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Reads cells by gmsh's element type. @param count  of the places that they connect
std::map<int, Eigen::MatrixXi> read_cells(const Hdf5File& file, const std::string& group, std::size_t count) {
  std::map<int, Eigen::MatrixXi> result;
  if (!file.has(group)) return result;
  for (const std::string& type : file.names_in(group)) {
    const std::string dataset = group + "/" + type;
    const Shape shape = file.shape(dataset);
    const Integers nodes = file.read_integers(dataset);
    if (shape.size() != 2 || !std::all_of(nodes.begin(), nodes.end(), [&](std::int64_t node) {
          return node >= 0 && node < static_cast<std::int64_t>(count);
        }))
      refuse_matrices(file, dataset + ": names places that the file does not have");
    Eigen::MatrixXi cells(static_cast<Eigen::Index>(shape[1]), static_cast<Eigen::Index>(shape[0]));
    std::transform(nodes.begin(), nodes.end(), cells.data(), [](std::int64_t node) { return static_cast<int>(node); });
    int number = 0;
    std::from_chars(type.data(), type.data() + type.size(), number);
    result[number] = std::move(cells);
  }
  return result;
}

NodalShapes read_shapes(const Hdf5File& file, std::size_t n) {
  NodalShapes shapes;
  shapes.numbers = file.read_integers("/shapes/numbers");
  const std::size_t p = shapes.numbers.size();
  shapes.points = columns_of_three(file, "/shapes/points", p);
  shapes.displacement = matrix_of(file, "/shapes/displacement", 3 * p, n);
  if (file.has("/shapes/rotation")) shapes.rotation = matrix_of(file, "/shapes/rotation", 3 * p, n);
  if (file.has("/shapes/masses")) {
    require_shape(file, "/shapes/masses", {p});
    shapes.masses = file.read_vector("/shapes/masses");
  }
  if (file.has("/shapes/inertias")) shapes.inertias = tensors(file, "/shapes/inertias", p);
  shapes.cells = read_cells(file, "/shapes/cells", p);
  if (!file.has("/shapes/stress")) return shapes;
  const Integers stressed = file.read_integers("/shapes/stress_points");
  shapes.stress = matrix_of(file, "/shapes/stress", 6 * stressed.size(), n);
  for (const std::int64_t point : stressed) {
    if (point < 0 || point >= static_cast<std::int64_t>(p))
      refuse_matrices(file, fmt::format("/shapes/stress_points: {} is no point", point));
    shapes.stress_points.push_back(static_cast<int>(point));
  }
  return shapes;
}

/// Reads quantities, and checks that they fit the unknowns and have finite numbers.
void read_set_quantities(const Hdf5File& file, MatrixSet& set) {
  set.quantities = read_quantities(file);
  if (const std::string fault = fault_of(set.quantities, set.size()); !fault.empty()) refuse_matrices(file, fault);
}

void read_stated_mass(const Hdf5File& file, MatrixSet& set) {
  if (!file.has("/mass_properties")) return;
  StatedMass stated;
  stated.mass = file.read_number("/mass_properties/mass");
  require_shape(file, "/mass_properties/centre", {3});
  stated.centre = file.read_vector("/mass_properties/centre");
  stated.inertia = matrix_of(file, "/mass_properties/inertia", 3, 3);
  set.stated = stated;
}

void read_inertia_components(const Hdf5File& file, MatrixSet& set) {
  constexpr const char* dataset = "/inertia_components";
  if (!file.has(dataset)) return;
  const auto n = static_cast<std::size_t>(set.size());
  require_shape(file, dataset, {6, n, n});
  const std::vector<double> values = finite_numbers(file, dataset);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  for (std::size_t k = 0; k < 6; ++k)
    set.inertia_components[k] = Eigen::Map<const Rows>(values.data() + k * n * n, set.size(), set.size());
}

}  // namespace

bool holds_matrices(const std::string& path) { return is_matrix_file(Hdf5File::open(path)); }

MatrixSet read_matrix_set(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path);
  if (!is_matrix_file(file))
    refuse_matrices(file, "is no file of matrices: its attribute `format` is not 'bielle matrices'");
  const std::int64_t version = file.read_integer_attribute("/", "version");
  if (version != version_of_matrices)
    refuse_matrices(
        file, fmt::format("has version {} of the format, and this program reads {}", version, version_of_matrices));
  MatrixSet set;
  set.name = file.read_text_attribute("/", "name");
  set.source = file.read_text_attribute("/", "source");
  set.has_units = file.has_attribute("/", "length_unit");
  read_nodes(file, set);
  read_unknowns(file, set);
  const Eigen::Index n = set.size();
  set.stiffness = read_sparse(file, "/stiffness", n);
  set.mass = read_sparse(file, "/mass", n);
  if (file.has("/damping")) set.damping = read_sparse(file, "/damping", n);
  if (file.has("/geometric_stiffness")) set.geometric_stiffness = read_sparse(file, "/geometric_stiffness", n);
  read_inertia_components(file, set);
  read_stated_mass(file, set);
  set.cells = read_cells(file, "/nodes/cells", set.numbers.size());
  read_set_quantities(file, set);
  if (file.has("/shapes")) set.shapes = read_shapes(file, static_cast<std::size_t>(n));
  if (file.has("/interfaces")) {
    const std::vector<std::string> names = file.read_names("/interfaces/names");
    const Integers nodes = file.read_integers("/interfaces/nodes");
    for (std::size_t k = 0; k < std::min(names.size(), nodes.size()); ++k) {
      if (nodes[k] < 0 || nodes[k] >= static_cast<std::int64_t>(set.numbers.size()))
        refuse_matrices(file, fmt::format("/interfaces/nodes: {} is no node", nodes[k]));
      set.interfaces[names[k]] = static_cast<int>(nodes[k]);
    }
  }
  return set;
}

}  // namespace bielle::reduce
