// Structured meshes of boxes with any type of solid cells.
#pragma once

#include <array>
#include <functional>

#include <Eigen/Core>

#include "reduce/mesh/mesh.hpp"

namespace bielle::test {

using PointMap = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// Returns a box [0,a]x[0,b]x[0,c] of bricks: one hexahedron each, two wedges along z, six pyramids around a node in
/// the middle, or six tetrahedra. The volume group is "solid", the surface groups "x0" "x1" "y0" "y1" "z0" "z1".
/// @param map  moves the vertices; nodes on edges, faces and in cells stay in the middle: cells have straight edges
/// @param curve  moves all nodes afterwards
reduce::Mesh cell_box(reduce::CellType type, const Eigen::Vector3d& size, std::array<int, 3> bricks,
                      const PointMap& map = {}, const PointMap& curve = {});

/// Returns the same with bricks of all types of order 1 or 2: columns along z of hexahedra, of wedges, and of pyramids,
/// with tetrahedra in place of their lowest and highest one.
reduce::Mesh mixed_box(int order, const Eigen::Vector3d& size, std::array<int, 3> bricks, const PointMap& map = {},
                       const PointMap& curve = {});

/// Moves points inside a box [0,a]x[0,b]x[0,c] smoothly by at most `amount` of its sides, those on its surface not at
/// all.
PointMap distortion(const Eigen::Vector3d& size, double amount);

}  // namespace bielle::test
