// Faces of solid cells: the faces on the surface of the body, and the face that belongs to a surface cell of a file.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/corners.hpp"
#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/solid_cells.hpp"

namespace bielle::reduce {

/// The faces of the solid cells of a mesh, each once, numbered from 0 in ascending order of their corner nodes.
///
/// A face is oriented outward of its solid cell; a face between two cells, outward of the cell with the lower number.
/// The table refers to the mesh.
class FaceTable {
 public:
  /// Makes the faces of the solid cells of a mesh. @throws InputError when three or more cells share a face
  explicit FaceTable(const Mesh& mesh);

  int size() const { return static_cast<int>(faces_.size()); }
  bool on_boundary(int face) const { return faces_[face].other < 0; }
  bool same_on_both_sides(int face) const;  ///< whether both cells have all its nodes, not only its corners
  bool on_one_side(int face) const;         ///< whether both cells, which are not inverted, lie on one side of it
  int cell(int face) const { return faces_[face].cell; }         ///< its (first) solid cell
  int other_cell(int face) const { return faces_[face].other; }  ///< its second one; -1 on the boundary
  CellType type(int face) const { return side_of(faces_[face].cell, faces_[face].side).type; }  ///< tri3, quad8, ...
  Eigen::VectorXi nodes(int face) const;  ///< all its nodes in gmsh's order of its type
  Corners corners(int face) const;        ///< three or four, outward
  /// Returns the face with these corners in any order.
  std::optional<int> find(const Corners& corners) const;
  std::vector<int> boundary() const;  ///< faces of one cell only, ascending

 private:
  struct Face {
    std::array<int, 4> key;  // corner nodes, ascending; -1 behind those of a triangle
    int cell, other;
    int side, other_side;  // sides of both cells
  };
  const CellFace& side_of(int cell, int side) const { return cell_info(cells_.type(cell)).faces[side]; }
  Corners corners_in(int cell, int side) const;
  SolidCells cells_;
  std::vector<Face> faces_;
};

}  // namespace bielle::reduce
