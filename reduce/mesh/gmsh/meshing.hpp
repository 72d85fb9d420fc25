// Meshing of the geometry that gmsh has open: surfaces, then volumes, then mid-side nodes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reduce/mesh/gmsh/session.hpp"

namespace bielle::reduce {

/// Edge length on some entities.
struct EntitySize {
  int dimension;  ///< 2 or 3
  std::vector<int> entities;
  double size;  ///< in the geometry's own unit
};

/// Edge lengths of a mesh, in the geometry's own unit.
struct MeshSizes {
  std::optional<double> largest;        ///< absent: as the geometry says
  std::vector<EntitySize> on_entities;  ///< fade into `largest` away from them
  std::optional<int> per_turn;          ///< edges on a full circle of a curved surface, at least
};

/// Edges that follow from `per_turn` are not smaller than `largest` divided by this number.
constexpr double most_refinement = 20;

/// Calls `work` with gmsh's options set to these sizes. gmsh's exceptions are not translated.
void with_sizes(const MeshSizes& sizes, const std::function<void()>& work);

/// Checks that all volumes have cells: gmsh may leave one without them and report it only in its log. gmsh's exceptions
/// are not translated.
/// @throws ComputationError about such a volume
void check_volumes_meshed(const std::string& name);

/// Expected number of cells in the volumes of a mesh of the open geometry: 8 per cube of the edge length, and 10 per
/// square on surfaces that are meshed finer than the rest. The estimate is correct within a factor of two for compact
/// bodies, and too low for bodies thinner than an edge length. Geometries of gmsh's own kernel do not know their
/// volume; a hundredth of their box is used. The result is 0 if the geometry alone determines the sizes.
double expected_cells(GmshSession& session, const std::string& name, const MeshSizes& sizes);

/// Meshes the surfaces with straight cells and replaces an earlier mesh.
/// @param name  name of the file in messages, here and below
/// @throws ComputationError when gmsh fails
void mesh_surfaces(GmshSession& session, const std::string& name, const MeshSizes& sizes);

/// Meshes the volumes between meshed surfaces, with the same sizes.
/// @throws ComputationError when gmsh fails, or leaves a volume without cells
void mesh_volumes(GmshSession& session, const std::string& name, const MeshSizes& sizes);

/// Puts mid-side nodes on the edges of a meshed geometry, on its curves and surfaces.
/// @param middle_nodes  whether quadrilateral faces and hexahedra get nodes in their middle, too
void make_second_order(GmshSession& session, const std::string& name, bool middle_nodes);

}  // namespace bielle::reduce
