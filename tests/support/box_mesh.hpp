// Structured tetrahedral meshes of boxes, for tests that must not depend on a mesh generator.
#pragma once

#include <array>
#include <functional>

#include <Eigen/Core>

#include "reduce/mesh/mesh.hpp"

namespace bielle::test {

/// A box [0,a]x[0,b]x[0,c] of nx*ny*nz bricks, each split into six tetrahedra around the brick's diagonal.
struct Box {
  Eigen::Vector3d size{1, 1, 1};       ///< a b c [m]
  std::array<int, 3> bricks{1, 1, 1};  ///< nx ny nz
  bool quadratic = true;               ///< tet10 and tri6, or tet4 and tri3
};

/// Returns the mesh, with the volume group "solid" and the surface groups "x0" "x1" "y0" "y1" "z0" "z1" (faces oriented
/// outward).
/// @param map  moves the points, mid-side nodes included: a non-linear map makes curved cells
reduce::Mesh box_mesh(const Box& box, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map = {});

/// Returns the same with vertices moved at random by at most `amount` of a brick's edge inside the box (fixed seed) and
/// mid-side nodes kept in the middle: straight-sided distorted cells.
reduce::Mesh distorted_box_mesh(const Box& box, double amount);

}  // namespace bielle::test
