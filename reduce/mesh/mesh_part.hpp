// A part of a mesh as a mesh of its own.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Some cells of a mesh, with the parts of the mesh's groups that they contain.
struct MeshPart {
  Mesh mesh;
  std::vector<int> nodes;  ///< number in the whole mesh of each of its points, ascending
};

/// Faces of the solid cells by surface group.
using SurfaceFaces = std::map<std::string, std::vector<int>>;

/// Returns the surface groups of a mesh as faces.
SurfaceFaces surface_faces(const Mesh& mesh, const FaceTable& faces);

/// Takes cells with their points out of a mesh. It refers to the mesh.
class MeshExtraction {
 public:
  /// @param parts  number of the part to which each solid cell belongs; the cells of `part` are extracted
  MeshExtraction(const Mesh& whole, const std::vector<int>& parts, int part);

  void add_volumes();
  /// Adds the groups of nodes all of which the part contains.
  void add_nodes();
  /// @param faces  faces of the whole mesh
  /// @param surfaces  each face goes to the part of its (first) cell
  /// @param cuts  each face goes to the parts on both sides
  void add_surfaces(const FaceTable& faces, const SurfaceFaces& surfaces, const SurfaceFaces& cuts);

  MeshPart take() { return std::move(part_); }

 private:
  bool has(int cell) const { return cell_in_part_[cell] >= 0; }
  const Mesh& whole_;
  std::vector<int> number_in_part_, cell_in_part_;  ///< -1: not in it
  MeshPart part_;
};

}  // namespace bielle::reduce
