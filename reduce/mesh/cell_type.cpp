#include "reduce/mesh/cell_type.hpp"

#include <algorithm>
#include <stdexcept>

namespace bielle::reduce {

namespace {

using Edges = std::vector<std::array<int, 2>>;

// Edges in the order of gmsh's mid-side nodes.
const Edges triangle = {{0, 1}, {1, 2}, {2, 0}};
const Edges quadrilateral = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
const Edges tetrahedron = {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {3, 1}};
const Edges hexahedron = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                          {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
const Edges wedge = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};
const Edges pyramid = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};

// Corners of the sides, outward. Those of hex27 are in the order of its nodes in the middle of the faces.
using Sides = std::vector<std::vector<int>>;
const Sides of_tetrahedron = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
const Sides of_hexahedron = {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
const Sides of_wedge = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}};
const Sides of_pyramid = {{0, 1, 4}, {3, 0, 4}, {1, 2, 4}, {2, 3, 4}, {0, 3, 2, 1}};

/// Returns the node in the middle of the edge between two vertices.
int middle(const CellInfo& cell, int a, int b) {
  for (std::size_t k = 0; k < cell.edges.size(); ++k) {
    const auto& [first, second] = cell.edges[k];
    if ((first == a && second == b) || (first == b && second == a)) return cell.vertices + static_cast<int>(k);
  }
  throw std::logic_error("no edge between these vertices");
}

/// Gives a cell its faces, with the nodes on their edges and, of hex27, in their middle.
CellInfo with_faces(CellInfo cell, const Sides& sides) {
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const std::vector<int>& corners = sides[side];
    const bool is_triangle = corners.size() == 3, has_middle = cell.nodes == 27;
    CellFace face{is_triangle ? CellType::tri3 : CellType::quad4, corners};
    if (cell.order == 2) {
      face.type = is_triangle ? CellType::tri6 : has_middle ? CellType::quad9 : CellType::quad8;
      for (std::size_t k = 0; k < corners.size(); ++k)
        face.nodes.push_back(middle(cell, corners[k], corners[(k + 1) % corners.size()]));
      if (has_middle) face.nodes.push_back(20 + static_cast<int>(side));
    }
    cell.faces.push_back(std::move(face));
  }
  return cell;
}

std::vector<CellInfo> make_table() {
  const auto flat = [](CellType type, const char* name, int order, int nodes, const Edges& edges) {
    return CellInfo{type, name, 2, order, nodes, static_cast<int>(edges.size()), false, edges, {}};
  };
  const auto solid = [](CellType type, const char* name, int order, int nodes, int vertices, const Edges& edges,
                        const Sides& sides) {
    const bool locks = order == 1 && type != CellType::hex8;
    return with_faces({type, name, 3, order, nodes, vertices, locks, edges, {}}, sides);
  };
  return {flat(CellType::tri3, "tri3", 1, 3, triangle),
          flat(CellType::tri6, "tri6", 2, 6, triangle),
          flat(CellType::quad4, "quad4", 1, 4, quadrilateral),
          flat(CellType::quad8, "quad8", 2, 8, quadrilateral),
          flat(CellType::quad9, "quad9", 2, 9, quadrilateral),
          solid(CellType::tet4, "tet4", 1, 4, 4, tetrahedron, of_tetrahedron),
          solid(CellType::tet10, "tet10", 2, 10, 4, tetrahedron, of_tetrahedron),
          solid(CellType::hex8, "hex8", 1, 8, 8, hexahedron, of_hexahedron),
          solid(CellType::hex20, "hex20", 2, 20, 8, hexahedron, of_hexahedron),
          solid(CellType::hex27, "hex27", 2, 27, 8, hexahedron, of_hexahedron),
          solid(CellType::wedge6, "wedge6", 1, 6, 6, wedge, of_wedge),
          solid(CellType::wedge15, "wedge15", 2, 15, 6, wedge, of_wedge),
          solid(CellType::pyramid5, "pyramid5", 1, 5, 5, pyramid, of_pyramid),
          solid(CellType::pyramid13, "pyramid13", 2, 13, 5, pyramid, of_pyramid)};
}

const CellInfo* find_type(int gmsh_type) {
  const std::vector<CellInfo>& table = cell_table();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const CellInfo& cell) { return static_cast<int>(cell.type) == gmsh_type; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace

const std::vector<CellInfo>& cell_table() {
  static const std::vector<CellInfo> table = make_table();
  return table;
}

const CellInfo& cell_info(CellType type) {
  // Types are found by number, because this is called for every face of a mesh.
  static const std::vector<const CellInfo*> by_number = [] {
    std::vector<const CellInfo*> all;
    for (int k = 0; k <= static_cast<int>(CellType::pyramid13); ++k) all.push_back(find_type(k));
    return all;
  }();
  return *by_number[static_cast<std::size_t>(type)];
}

bool is_cell_type(int gmsh_type) { return find_type(gmsh_type) != nullptr; }

}  // namespace bielle::reduce
