// Checks that a mesh can be reduced. Messages name the element and its place.
#pragma once

#include <string>
#include <vector>

#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Checks that the straight cell of the vertices has a Jacobian determinant of more than 1e-12 of its longest edge
/// cubed: of a tetrahedron its only one, of other cells at the places of `checked_determinants`.
/// @param cell_tags  numbers of the cells in the user's file; may be empty (cells are then numbered from 1)
/// @throws InputError: inverted or flat elements, the first by number and place
void check_elements(const Mesh& mesh, const std::vector<std::size_t>& cell_tags);

/// Checks that the solid is one piece: its cells are connected by common nodes.
/// @param cell_tags  as above
/// @throws InputError: number, size and place of the pieces, and whether they overlap or touch without sharing nodes
void check_connected(const Mesh& mesh, const std::vector<std::size_t>& cell_tags = {});

/// Returns a sentence if parts of the body are connected by single nodes or edges only, about which they can turn; else
/// empty. @param cell_tags  as above
/// @throws InputError if such parts overlap
std::string loose_joints(const Mesh& mesh, const FaceTable& faces, const std::vector<std::size_t>& cell_tags = {});

/// Pairs of boundary nodes at one place, nearer than 1e-6 of the shortest edge: a crack, or an unmerged mesh.
struct CoincidentNodes {
  int pairs = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< place of the first pair [m]
};
CoincidentNodes coincident_nodes(const Mesh& mesh, const FaceTable& faces);

/// Returns a sentence if the mesh has wedges of order 1, with the number of those that are a layer of their own between
/// two surfaces, where bending is falsified most; else empty.
std::string stiff_wedges(const Mesh& mesh, const FaceTable& faces);

/// Returns a sentence if the body is longer than 150 m or smaller than 1 mm, probably because of a wrong unit of
/// length; else empty.
std::string implausible_size(const Mesh& mesh);
std::string implausible_length(double metres);  ///< the same sentence for a body of this largest extent

/// Quality of the solid cells.
struct MeshQuality {
  double shortest_edge = 0, longest_edge = 0;             ///< [m], straight
  double least_scaled_jacobian = 0;                       ///< quality of the straight cells: 1 regular, 0 flat
  Eigen::Vector3d worst_place = Eigen::Vector3d::Zero();  ///< [m]
};
MeshQuality mesh_quality(const Mesh& mesh);

/// "4321 nodes, 2345 tet10, edges from 0.9 mm to 3.2 mm, least scaled Jacobian 0.12 at (..) m"
std::string summary(const Mesh& mesh);

}  // namespace bielle::reduce
