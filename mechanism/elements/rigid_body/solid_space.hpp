// Detects parts of cuts that are cut out twice or lie outside of all material: densities are summed at every point,
// cuts have a negative density, and the sum must not be negative at any point.
//
// Points are sampled: each solid has cells of equal parts of its own coordinates (x y z of a box; radius, angle and
// height of a solid of revolution), 24 along each, with one point in the middle of each cell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

/// The space of a solid in its own axes, where z is the axis of revolution and the middle is that of
/// mass_properties.hpp.
struct SolidSpace {
  std::function<bool(const Vector3&)> contains;
  std::vector<Vector3> places;
  std::vector<double> shares;  ///< fraction of the solid's volume at each point; the sum is 1
};

SolidSpace box_space(const Vector3& edges);
SolidSpace sphere_space(double radius);
SolidSpace tube_space(double outer, double inner, double length);
SolidSpace cone_space(double below, double above, double length);
SolidSpace ring_space(double radius, double section);

/// A solid at its position.
struct PlacedSpace {
  SolidSpace space;
  Frame frame;         ///< frame of its axes, in those of the body
  double density = 0;  ///< [kg/m^3], negative for a cut
};

/// The empty part of a cut: the part that contains no material to cut out.
struct EmptyCut {
  std::size_t solid = 0;  ///< number of the solid in the list
  double share = 0;       ///< fraction of the cut's volume, 0..1
  /// Index of the first other cut that shares some of this part; -1: the part lies outside of all material.
  int other = -1;
};

/// Returns the cuts that are partly empty, in the order of `solids`. If two cuts share a part, the later one is listed.
std::vector<EmptyCut> empty_cuts(const std::vector<PlacedSpace>& solids);

}  // namespace bielle::mechanism
