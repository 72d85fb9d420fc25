// The space occupied by solids shows whether a part is cut out twice, or outside of material: densities are summed at
// every point, a cut has a negative density, and the sum must not be negative at any point.
//
// Points are sampled: each solid has cells of equal parts of its own coordinates (x y z of a box; radius, angle and
// height of a solid of revolution), 24 along each, with one point in the middle of each cell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

/// The space of a solid in its own axes, with z the axis of revolution; the middle as in mass_properties.hpp.
struct SolidSpace {
  std::function<bool(const Vector3&)> contains;
  std::vector<Vector3> places;
  std::vector<double> shares;  ///< fraction of its volume for each point, with the sum 1
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
  double density = 0;  ///< [kg/m^3], negative if it is cut out
};

/// The empty part of a cut solid: it contains no material to cut out.
struct EmptyCut {
  std::size_t solid = 0;  ///< number of the solid in the list
  double share = 0;       ///< fraction of its volume, 0..1
  /// The first other cut that shares some of that part; without one the part is outside of all material.
  int other = -1;
};

/// Returns the cuts of which some part is empty, in the order of `solids`. If two cuts share a part, the later one is
/// listed.
std::vector<EmptyCut> empty_cuts(const std::vector<PlacedSpace>& solids);

}  // namespace bielle::mechanism
