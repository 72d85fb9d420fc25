// Division of a mesh into pieces along planes.
//
// A cell belongs to the side of a plane on which the mean of its corners lies; a piece is a connected set of cells on
// the same sides of all planes. If the geometry was cut (cut_geometry.hpp), faces of cells lie in the planes, and so do
// the cuts. Otherwise the cuts follow the faces of cells next to the planes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_part.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle::reduce {

/// A connected surface where two pieces meet.
struct MeshCut {
  std::string name;           ///< name of its plane; "cut_1_2" for the second surface if a plane cuts in several places
  std::string group;          ///< its surface group in both pieces
  std::size_t plane = 0;      ///< number in the list
  std::array<int, 2> pieces;  ///< numbers from 0, the lower one first
  double distance = 0;        ///< distance of its farthest corner from the plane [m]
};

struct CutMesh {
  std::vector<MeshPart> pieces;  ///< in the order in which they hang together
  std::vector<MeshCut> cuts;     ///< in the order of the planes
};

/// @param first  group of a surface or of nodes at which the numbering of the pieces starts; if it is empty or in no
/// cell, the start is arbitrary
/// @throws InputError for a plane that does not cut the body, and for planes that intersect inside the body
CutMesh cut_mesh(const Mesh& mesh, const std::vector<CutPlane>& planes, const std::string& first);

}  // namespace bielle::reduce
