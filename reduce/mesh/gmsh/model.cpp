#include "reduce/mesh/gmsh/model.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

using Tags = std::vector<std::size_t>;

// gmsh's node tags, which may be sparse, and their coordinates.
struct Nodes {
  std::unordered_map<std::size_t, int> number;
  Eigen::Matrix3Xd points;
};

// Upper bound of coordinates; larger ones are errors [m].
constexpr double farthest = 1e12;

// @throws InputError for coordinates that are not finite numbers
Nodes read_nodes(double metres, const std::string& name) {
  Tags tags;
  std::vector<double> coordinates, parametric;
  gmsh::model::mesh::getNodes(tags, coordinates, parametric);
  Nodes nodes;
  nodes.number.reserve(tags.size());
  nodes.points = metres * Eigen::Map<Eigen::Matrix3Xd>(coordinates.data(), 3, coordinates.size() / 3);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    nodes.number.emplace(tags[i], static_cast<int>(i));
    const auto x = nodes.points.col(static_cast<Eigen::Index>(i));
    if (!(x.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() < farthest))
      throw InputError(fmt::format("'{}': node {} stands at ({:g}, {:g}, {:g}) m: no body reaches there", name, tags[i],
                                   x[0], x[1], x[2]));
  }
  return nodes;
}

std::string gmsh_cell_name(int type) {
  std::string name;
  int dim, order, nodes, primary;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, name, dim, order, nodes, local, primary);
  return name;
}

std::vector<int> entities(int dim) {
  gmsh::vectorpair pairs;
  gmsh::model::getEntities(pairs, dim);
  std::vector<int> tags;
  for (const auto& [d, tag] : pairs) tags.push_back(tag);
  return tags;
}

// Calls visit(entity, type, element tags, node tags) for every block of elements of one dimension.
template <class Visit>
void visit_elements(int dim, const Visit& visit) {
  for (int entity : entities(dim)) {
    std::vector<int> types;
    std::vector<Tags> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dim, entity);
    for (std::size_t i = 0; i < types.size(); ++i) visit(entity, types[i], elements[i], nodes[i]);
  }
}

// A shape of cells in gmsh's count.
struct CellShape {
  const char* gmsh_name;
  const char* plural;
  int dimension, vertices;
};
constexpr CellShape cell_shapes[] = {{"Triangles", "triangles", 2, 3},    {"Quadrangles", "quadrilaterals", 2, 4},
                                     {"Tetrahedra", "tetrahedra", 3, 4},  {"Hexahedra", "hexahedra", 3, 8},
                                     {"Prisms", "wedges (prisms)", 3, 6}, {"Pyramids", "pyramids", 3, 5}};

// "8, 20 or 27": numbers of nodes of the types of a shape.
std::string node_counts(const CellShape& shape) {
  std::vector<int> counts;
  for (const CellInfo& cell : cell_table())
    if (cell.dimension == shape.dimension && cell.vertices == shape.vertices) counts.push_back(cell.nodes);
  const auto last = counts.end() - 1;
  return fmt::format("{} or {}", fmt::join(counts.begin(), last, ", "), *last);
}

// "triangles with 3 or 6 nodes, quadrilaterals with ..": all supported types of a dimension.
std::string supported_types(int dimension) {
  std::vector<std::string> names;
  for (const CellShape& shape : cell_shapes)
    if (shape.dimension == dimension)
      names.push_back(fmt::format("{} with {} nodes", shape.plural, node_counts(shape)));
  return fmt::format("{}", fmt::join(names, ", "));
}

// "12 hex8 and 3 wedge6"
std::string counts_text(const std::map<int, std::size_t>& counts) {
  std::vector<std::string> names;
  for (const auto& [type, count] : counts)
    names.push_back(fmt::format("{} {}", count, cell_name(static_cast<CellType>(type))));
  return fmt::format("{}", fmt::join(names, " and "));
}

// @throws InputError for types that are not in the table
void check_types(const std::map<int, std::size_t>& counts, int dimension, const std::string& name) {
  for (const auto& [type, count] : counts)
    if (!is_cell_type(type))
      throw InputError(fmt::format("'{}' holds {} of type '{}', which is not supported; supported are {}", name,
                                   counted(count, dimension == 3 ? "cell" : "surface cell"), gmsh_cell_name(type),
                                   supported_types(dimension)));
}

// gmsh returns, for one entity and shape, only the cells of the first one's order, without a message; its own count
// reveals it.
// @throws InputError if cells of one shape on one entity have different numbers of nodes
void check_all_delivered(const std::map<int, std::size_t>& counts, int dimension, const std::string& name) {
  for (const CellShape& shape : cell_shapes) {
    if (shape.dimension != dimension) continue;
    std::map<int, std::size_t> of_shape;
    std::size_t delivered = 0;
    for (const auto& [type, count] : counts)
      if (vertex_count(static_cast<CellType>(type)) == shape.vertices) {
        of_shape[type] = count;
        delivered += count;
      }
    double all = 0;
    gmsh::option::getNumber(std::string("Mesh.Nb") + shape.gmsh_name, all);
    if (static_cast<double>(delivered) == all) continue;
    const bool two_kinds = shape.vertices == shape.dimension + 1;
    const std::string kinds = two_kinds
                                  ? fmt::format("with {} and with {} nodes", shape.vertices, dimension == 2 ? 6 : 10)
                                  : "with different numbers of nodes";
    throw InputError(fmt::format("'{}' mixes {} {} {} ({} of {} {}): {}use one kind", name, shape.plural, kinds,
                                 dimension == 2 ? "on one surface" : "in one volume", counts_text(of_shape), all,
                                 all == 1 ? "cell" : "cells",
                                 dimension == 3 ? "their common faces do not fit together; " : ""));
  }
}

// Numbers of the cells of each type.
std::map<int, std::size_t> counts_of_types(int dimension) {
  std::map<int, std::size_t> counts;
  visit_elements(dimension, [&](int, int type, const Tags& elements, const Tags&) { counts[type] += elements.size(); });
  return counts;
}

// @throws InputError for cells that are not in the table
std::map<int, std::vector<Corners>> read_surfaces(const Nodes& nodes, const std::string& name) {
  const std::map<int, std::size_t> counts = counts_of_types(2);
  check_types(counts, 2, name);
  check_all_delivered(counts, 2, name);
  std::map<int, std::vector<Corners>> surfaces;
  visit_elements(2, [&](int entity, int type, const Tags& elements, const Tags& tags) {
    const std::size_t width = tags.size() / elements.size();
    for (std::size_t e = 0; e < elements.size(); ++e) {
      Corners corners;
      for (int k = 0; k < vertex_count(static_cast<CellType>(type)); ++k)
        corners.push_back(nodes.number.at(tags[e * width + k]));
      surfaces[entity].push_back(corners);
    }
  });
  return surfaces;
}

// Reads the solid cells with the original numbers of their nodes. @throws InputError
void read_solids(const Nodes& nodes, const std::string& name, ExtractedModel& model) {
  const std::map<int, std::size_t> counts = counts_of_types(3);
  check_types(counts, 3, name);
  check_all_delivered(counts, 3, name);
  if (counts.empty()) {
    std::size_t flat = 0;
    for (const auto& [type, count] : counts_of_types(2)) flat += count;
    throw InputError(flat > 0 ? fmt::format("'{}' holds a surface mesh only ({}); a body needs tetrahedra or other "
                                            "solid cells: mesh its volume",
                                            name, counted(flat, "cell"))
                              : fmt::format("'{}' holds no cells", name));
  }
  struct Target {
    std::size_t block;
    int first, next;  // number of the block's first cell; column of its next one
  };
  std::map<int, Target> targets;
  int cells = 0;
  for (const auto& [type, count] : counts) {
    targets[type] = {model.solids.size(), cells, 0};
    model.solids.push_back(
        {static_cast<CellType>(type), Eigen::MatrixXi(node_count(static_cast<CellType>(type)), count)});
    cells += static_cast<int>(count);
  }
  model.cell_tags.resize(cells);
  visit_elements(3, [&](int entity, int type, const Tags& elements, const Tags& tags) {
    Target& target = targets.at(type);
    Eigen::MatrixXi& block = model.solids[target.block].nodes;
    for (std::size_t e = 0; e < elements.size(); ++e, ++target.next) {
      for (Eigen::Index k = 0; k < block.rows(); ++k)
        block(k, target.next) = nodes.number.at(tags[e * block.rows() + k]);
      const int cell = target.first + target.next;
      model.cell_tags[cell] = elements[e];
      model.volumes[entity].push_back(cell);
    }
  });
}

// Renumbers so that exactly the nodes of solid cells remain, in their original order.
void drop_unused_nodes(const Nodes& nodes, ExtractedModel& model) {
  std::vector<int> number(nodes.points.cols(), -1);
  for (const CellBlock& block : model.solids)
    for (const int node : block.nodes.reshaped()) number[node] = 0;
  int used = 0;
  for (int& n : number)
    if (n == 0) n = used++;
  model.dropped_nodes = number.size() - used;
  model.points.resize(3, used);
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] >= 0) model.points.col(number[i]) = nodes.points.col(i);
  model.node_tags.resize(used);
  for (const auto& [tag, i] : nodes.number)
    if (number[i] >= 0) model.node_tags[number[i]] = tag;
  for (CellBlock& block : model.solids)
    for (int& node : block.nodes.reshaped()) node = number[node];
  for (auto& [entity, cells] : model.surfaces)
    for (Corners& corners : cells)
      for (int& node : corners) node = number[node];
}

// gmsh sets OpenCASCADE's unit before the reader of IGES files exists, which fails unless a file has been read before.
void initialise_units(const std::string& path) {
  gmsh::option::setString("Geometry.OCCTargetUnit", "");
  gmsh::open(path);
  gmsh::clear();
}

}  // namespace

void open_model(GmshSession& session, const SourceFile& source) {
  session.read(fmt::format("'{}' cannot be read", source.name), [&] {
    // OpenCASCADE's unit is not reset at the end of a session. Files that a .geo merges are read in mm, which is gmsh's
    // default.
    if (source.is_iges) initialise_units(source.path);
    gmsh::option::setString("Geometry.OCCTargetUnit", source.carries_unit ? "M" : "MM");
    gmsh::open(source.path);
    if (entities(0).empty() && entities(2).empty() && entities(3).empty())
      throw InputError(
          fmt::format("'{}' cannot be read: gmsh finds nothing in it: is it a file of the kind that its ending says?",
                      source.name));
  });
}

bool model_has_cells(int dimension) {
  bool found = false;
  visit_elements(dimension, [&](int, int, const Tags& elements, const Tags&) { found |= !elements.empty(); });
  return found;
}

std::vector<std::pair<std::string, std::size_t>> cell_counts() {
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (int dimension : {3, 2}) {
    std::map<int, std::size_t> of_type;
    visit_elements(dimension,
                   [&](int, int type, const Tags& elements, const Tags&) { of_type[type] += elements.size(); });
    for (const auto& [type, count] : of_type) counts.emplace_back(gmsh_cell_name(type), count);
  }
  return counts;
}

bool model_has_volumes() { return !entities(3).empty(); }

std::vector<PhysicalGroup> physical_groups() {
  std::vector<PhysicalGroup> groups;
  std::set<std::string> names;
  for (int dim : {3, 2}) {
    gmsh::vectorpair pairs;
    gmsh::model::getPhysicalGroups(pairs, dim);
    for (const auto& [d, tag] : pairs) {
      PhysicalGroup group;
      group.dimension = dim;
      gmsh::model::getPhysicalName(dim, tag, group.name);
      if (group.name.empty()) group.name = fmt::format("{}_{}", dim == 3 ? "volume" : "surface", tag);
      if (names.contains(group.name)) group.name += dim == 2 ? "_surface" : fmt::format("_{}", tag);
      names.insert(group.name);
      gmsh::model::getEntitiesForPhysicalGroup(dim, tag, group.entities);
      for (int& entity : group.entities) entity = std::abs(entity);
      groups.push_back(group);
    }
  }
  return groups;
}

double model_extent(GmshSession& session) {
  double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
  session.read("the geometry has no box", [&] { gmsh::model::getBoundingBox(-1, -1, x0, y0, z0, x1, y1, z1); });
  return std::max({x1 - x0, y1 - y0, z1 - z0});
}

ExtractedModel extract_model(GmshSession& session, const std::string& name, double metres) {
  ExtractedModel model;
  session.read(fmt::format("'{}' cannot be read", name), [&] {
    const Nodes nodes = read_nodes(metres, name);
    read_solids(nodes, name, model);
    model.surfaces = read_surfaces(nodes, name);
    model.groups = physical_groups();
    drop_unused_nodes(nodes, model);
  });
  return model;
}

std::map<int, std::vector<Corners>> extract_surfaces(GmshSession& session, const std::string& name, double metres,
                                                     Eigen::Matrix3Xd& points) {
  std::map<int, std::vector<Corners>> surfaces;
  session.read(fmt::format("'{}' cannot be read", name), [&] {
    const Nodes nodes = read_nodes(metres, name);
    points = nodes.points;
    surfaces = read_surfaces(nodes, name);
  });
  return surfaces;
}

}  // namespace bielle::reduce
