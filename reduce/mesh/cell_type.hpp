// Types of cells: their nodes, vertices, edges and faces. Everything else that depends on the type of a cell follows
// from this table and from the shape functions.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace bielle::reduce {

/// Types by gmsh's numbers; the order of the nodes in a cell is gmsh's.
enum class CellType : int {
  tri3 = 2,
  quad4 = 3,
  tet4 = 4,
  hex8 = 5,
  wedge6 = 6,
  pyramid5 = 7,
  tri6 = 9,
  quad9 = 10,
  tet10 = 11,
  hex27 = 12,
  quad8 = 16,
  hex20 = 17,
  wedge15 = 18,
  pyramid13 = 19
};

/// One side of a solid cell.
struct CellFace {
  CellType type;
  std::vector<int> nodes;  ///< nodes of the cell in gmsh's order for the face's type; corners run round outward
};

struct CellInfo {
  CellType type;
  std::string name;   ///< "hex20"
  int dimension = 0;  ///< 2 or 3
  int order = 0;      ///< 1: nodes at the vertices only, 2: at the edges as well
  int nodes = 0;
  int vertices = 0;                       ///< its first nodes
  bool locks = false;                     ///< far too stiff in bending: solid cells of order 1 but hex8
  std::vector<std::array<int, 2>> edges;  ///< vertices of each edge; its mid-side node, if any, is node `vertices` + k
  std::vector<CellFace> faces;            ///< of a solid cell
};

/// Returns the properties of a type.
const CellInfo& cell_info(CellType type);

/// All types, surface cells first.
const std::vector<CellInfo>& cell_table();

/// Returns whether gmsh's number of a type is one of the table.
bool is_cell_type(int gmsh_type);

inline int node_count(CellType type) { return cell_info(type).nodes; }
inline int vertex_count(CellType type) { return cell_info(type).vertices; }
inline int dimension(CellType type) { return cell_info(type).dimension; }
inline const std::string& cell_name(CellType type) { return cell_info(type).name; }

}  // namespace bielle::reduce
