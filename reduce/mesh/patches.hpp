// The surface of a body as faces that a user would name: surfaces of the geometry, or parts of a mesh between sharp
// edges.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "reduce/mesh/selectors.hpp"
#include "reduce/mesh/shapes.hpp"

namespace bielle::reduce {

/// A connected part of the surface, bounded by sharp edges or by those of the geometry's surface.
struct Patch {
  std::vector<int> sides;
  int entity = 0;          ///< surface of the geometry; 0 on a mesh without geometry
  double area = 0;         ///< area of the plane triangles of its sides [m^2]
  Eigen::Vector3d centre;  ///< centroid [m]
  Eigen::AlignedBox3d box;
  Shape shape;
  bool hollow = false;  ///< a cylinder whose inside is empty: a bore. Known where sides are known to be outward
};

/// Divides the surface, by surfaces of the geometry if known, otherwise at edges at which the normal turns by more than
/// 40 degrees. The largest patch comes first.
std::vector<Patch> find_patches(const Eigen::Matrix3Xd& points, const BodySurface& surface);

/// Returns a hint for a selector that found nothing: "; the nearest cylinders are: ..." (planes; surfaces for a box
/// alone).
std::string near_candidates(const ShapeSelector& shape, const Eigen::Matrix3Xd& points, const BodySurface& surface);

}  // namespace bielle::reduce
