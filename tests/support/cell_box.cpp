#include "tests/support/cell_box.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/shape_functions.hpp"

namespace bielle::test {

namespace {

using reduce::CellFace;
using reduce::CellInfo;
using reduce::CellType;
using Corners = Eigen::Matrix3Xd;

Corners columns(const std::vector<Eigen::Vector3d>& points) {
  Corners all(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) all.col(static_cast<Eigen::Index>(k)) = points[k];
  return all;
}

/// Returns the vertices of the cells of a unit cube.
std::vector<Corners> cells_of_cube(int vertices) {
  const auto corner = [](int i, int j, int k) { return Eigen::Vector3d(i, j, k); };
  const std::vector<Eigen::Vector3d> cube = {corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0),
                                             corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)};
  std::vector<Corners> cells;
  if (vertices == 8) cells = {columns(cube)};
  if (vertices == 6)
    cells = {columns({cube[0], cube[1], cube[2], cube[4], cube[5], cube[6]}),
             columns({cube[0], cube[2], cube[3], cube[4], cube[6], cube[7]})};
  if (vertices == 5)
    for (const CellFace& face : reduce::cell_info(CellType::hex8).faces)  // the base looks inward
      cells.push_back(
          columns({cube[static_cast<std::size_t>(face.nodes[0])], cube[static_cast<std::size_t>(face.nodes[3])],
                   cube[static_cast<std::size_t>(face.nodes[2])], cube[static_cast<std::size_t>(face.nodes[1])],
                   Eigen::Vector3d::Constant(0.5)}));
  if (vertices == 4) {  // Kuhn's division
    std::array<int, 3> axes{0, 1, 2};
    do {
      std::vector<Eigen::Vector3d> tet{Eigen::Vector3d::Zero()};
      for (const int axis : axes) tet.push_back(tet.back() + Eigen::Vector3d::Unit(axis));
      if ((axes[0] + 1) % 3 != axes[1]) std::swap(tet[2], tet[3]);
      cells.push_back(columns(tet));
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return cells;
}

/// Nodes by their places in the undistorted box.
class Nodes {
 public:
  explicit Nodes(const Eigen::Vector3d& size) : size_(size) {}
  int at(const Eigen::Vector3d& place) {
    std::array<long, 3> key{};
    for (int i = 0; i < 3; ++i) key[static_cast<std::size_t>(i)] = std::lround(place(i) / size_(i) * 1e6);
    const auto [found, is_new] = numbers_.try_emplace(key, static_cast<int>(numbers_.size()));
    return found->second;
  }
  std::size_t size() const { return numbers_.size(); }

 private:
  Eigen::Vector3d size_;
  std::map<std::array<long, 3>, int> numbers_;
};

std::vector<int> sorted_nodes(const Eigen::MatrixXi& nodes, const std::vector<int>& cells) {
  std::vector<int> all;
  for (const int cell : cells) all.insert(all.end(), nodes.col(cell).begin(), nodes.col(cell).end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// A cell in a unit cube.
struct UnitCell {
  CellType type;
  Corners corners;
};

using CellsOfBrick = std::function<std::vector<UnitCell>(int i, int j, int k)>;

/// Returns the places of all nodes of a cell from its corners: (corners, nodes).
Eigen::MatrixXd shares_of_corners(CellType type) {
  const Eigen::MatrixXd local = reduce::local_nodes(type);
  Eigen::MatrixXd shares(reduce::vertex_count(type), local.cols());
  for (Eigen::Index a = 0; a < local.cols(); ++a)
    shares.col(a) = reduce::shape_values(reduce::straight_type(type), local.col(a));
  return shares;
}

using CellLists = std::map<CellType, std::vector<std::vector<int>>>;

/// Appends the cells of each type to a mesh, and the parts of groups to its groups.
void add_blocks(const CellLists& lists, reduce::Mesh& mesh) {
  for (const auto& [type, all] : lists) {
    reduce::CellBlock block{type, Eigen::MatrixXi(node_count(type), static_cast<Eigen::Index>(all.size()))};
    for (std::size_t e = 0; e < all.size(); ++e)
      block.nodes.col(static_cast<Eigen::Index>(e)) =
          Eigen::Map<const Eigen::VectorXi>(all[e].data(), node_count(type));
    mesh.blocks.push_back(std::move(block));
  }
}

reduce::Group group_of(const reduce::Mesh& mesh, const std::map<CellType, std::vector<int>>& parts) {
  reduce::Group group;
  for (const auto& [type, cells] : parts) {
    group.dimension = reduce::dimension(type);
    group.parts.push_back({type, cells});
    const std::vector<int> more = sorted_nodes(mesh.block(type)->nodes, cells);
    group.nodes.insert(group.nodes.end(), more.begin(), more.end());
  }
  std::sort(group.nodes.begin(), group.nodes.end());
  group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
  return group;
}

reduce::Mesh box_of(const CellsOfBrick& cells_of_brick, const Eigen::Vector3d& size, std::array<int, 3> bricks,
                    const PointMap& map, const PointMap& curve) {
  const Eigen::Vector3d brick = size.cwiseQuotient(Eigen::Vector3d(bricks[0], bricks[1], bricks[2]));
  Nodes nodes(size);
  std::map<int, Eigen::Vector3d> places;
  CellLists cells, faces;
  std::map<std::string, std::map<CellType, std::vector<int>>> groups;
  const auto add = [&](const UnitCell& unit, const Eigen::Vector3d& corner_of_brick) {
    const CellInfo& cell = reduce::cell_info(unit.type);
    const Eigen::MatrixXd shares = shares_of_corners(unit.type);
    const Corners corners = brick.asDiagonal() * (unit.corners.colwise() + corner_of_brick);
    Corners moved = corners;
    for (Eigen::Index v = 0; map && v < moved.cols(); ++v) moved.col(v) = map(corners.col(v));
    const Corners drawn = corners * shares, real = moved * shares;
    std::vector<int> numbers;
    for (int a = 0; a < cell.nodes; ++a) {
      numbers.push_back(nodes.at(drawn.col(a)));
      places[numbers.back()] = curve ? curve(real.col(a)) : Eigen::Vector3d(real.col(a));
    }
    for (const CellFace& face : cell.faces)
      for (int axis = 0; axis < 3; ++axis)
        for (const double end : {0.0, size(axis)})
          if (std::all_of(face.nodes.begin(), face.nodes.end(),
                          [&](int a) { return std::abs(drawn(axis, a) - end) < 1e-9 * size(axis); })) {
            std::vector<int> of_face;
            for (const int a : face.nodes) of_face.push_back(numbers[static_cast<std::size_t>(a)]);
            groups[std::string(1, "xyz"[axis]) + (end == 0 ? '0' : '1')][face.type].push_back(
                static_cast<int>(faces[face.type].size()));
            faces[face.type].push_back(of_face);
          }
    groups["solid"][unit.type].push_back(static_cast<int>(cells[unit.type].size()));
    cells[unit.type].push_back(std::move(numbers));
  };
  for (int k = 0; k < bricks[2]; ++k)
    for (int j = 0; j < bricks[1]; ++j)
      for (int i = 0; i < bricks[0]; ++i)
        for (const UnitCell& unit : cells_of_brick(i, j, k)) add(unit, Eigen::Vector3d(i, j, k));

  reduce::Mesh mesh;
  mesh.points.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (const auto& [number, place] : places) mesh.points.col(number) = place;
  add_blocks(cells, mesh);
  add_blocks(faces, mesh);
  for (const auto& [name, parts] : groups) mesh.groups[name] = group_of(mesh, parts);
  return mesh;
}

/// Returns the type of an order with this number of vertices; hex20, not hex27.
CellType type_of(int vertices, int order) {
  switch (vertices) {
    case 4:
      return order == 1 ? CellType::tet4 : CellType::tet10;
    case 5:
      return order == 1 ? CellType::pyramid5 : CellType::pyramid13;
    case 6:
      return order == 1 ? CellType::wedge6 : CellType::wedge15;
    default:
      return order == 1 ? CellType::hex8 : CellType::hex20;
  }
}

std::vector<UnitCell> cells_of_type(CellType type) {
  std::vector<UnitCell> cells;
  for (const Corners& corners : cells_of_cube(reduce::vertex_count(type))) cells.push_back({type, corners});
  return cells;
}

/// Returns a pyramid as two tetrahedra, between which the diagonal of its base lies.
std::vector<UnitCell> halves_of_pyramid(const Corners& pyramid, int order) {
  const auto tetrahedron = [&](int a, int b, int c) {
    return UnitCell{type_of(4, order), columns({pyramid.col(a), pyramid.col(b), pyramid.col(c), pyramid.col(4)})};
  };
  return {tetrahedron(0, 1, 2), tetrahedron(0, 2, 3)};
}

}  // namespace

reduce::Mesh cell_box(CellType type, const Eigen::Vector3d& size, std::array<int, 3> bricks, const PointMap& map,
                      const PointMap& curve) {
  return box_of([&](int, int, int) { return cells_of_type(type); }, size, bricks, map, curve);
}

reduce::Mesh mixed_box(int order, const Eigen::Vector3d& size, std::array<int, 3> bricks, const PointMap& map,
                       const PointMap& curve) {
  const auto cells = [&](int i, int j, int k) {
    const int vertices = std::array{8, 6, 5}[static_cast<std::size_t>((i + j) % 3)];
    std::vector<UnitCell> result;
    for (const UnitCell& cell : cells_of_type(type_of(vertices, order))) {
      const double low = cell.corners.row(2).head(4).maxCoeff(), high = cell.corners.row(2).head(4).minCoeff();
      if (vertices == 5 && ((k == 0 && low == 0) || (k == bricks[2] - 1 && high == 1))) {
        for (const UnitCell& half : halves_of_pyramid(cell.corners, order)) result.push_back(half);
      } else {
        result.push_back(cell);
      }
    }
    return result;
  };
  return box_of(cells, size, bricks, map, curve);
}

PointMap distortion(const Eigen::Vector3d& size, double amount) {
  return [=](const Eigen::Vector3d& x) {
    const Eigen::Array3d s = (M_PI * x.cwiseQuotient(size)).array().sin();
    const double inside = s.prod();  // zero on the surface
    const Eigen::Vector3d way(std::cos(3 * x.y() / size.y()), std::sin(2 + 5 * x.z() / size.z()),
                              std::cos(1 + 4 * x.x() / size.x()));
    return Eigen::Vector3d(x + amount * inside * size.cwiseProduct(way));
  };
}

}  // namespace bielle::test
