// The space that solids fill tells whether a part is cut out twice, or cut out of nothing: densities add up at every
// place, a solid that is cut out has a negative density, and no place may be left with a negative sum.
//
// Places are sampled: each solid has cells of equal parts of its own coordinates (x y z of a box; radius, angle and
// height of what turns about an axis), 24 along each, and one place in the middle of each cell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

/// The space of a solid in its own axes, z the axis of what turns about one; the middle as in mass_properties.hpp.
struct SolidSpace {
  std::function<bool(const Vector3&)> contains;
  std::vector<Vector3> places;
  std::vector<double> shares;  ///< of its volume that each place stands for, 1 together
};

SolidSpace box_space(const Vector3& edges);
SolidSpace sphere_space(double radius);
SolidSpace tube_space(double outer, double inner, double length);
SolidSpace cone_space(double below, double above, double length);
SolidSpace ring_space(double radius, double section);

/// A solid at its place.
struct PlacedSpace {
  SolidSpace space;
  Frame frame;         ///< of its axes, in the body's
  double density = 0;  ///< [kg/m^3], negative where it is cut out
};

/// An empty cut is the part of a cut solid that lies where there is nothing to cut out.
struct EmptyCut {
  std::size_t solid = 0;  ///< its number in the list
  double share = 0;       ///< of its volume, 0..1
  /// The first other cut that shares some of that part; without one the part lies outside of all that has mass.
  int other = -1;
};

/// The list holds the cuts of which some part is empty, in the order of `solids`. If two cuts share a part, the later
/// one is named.
std::vector<EmptyCut> empty_cuts(const std::vector<PlacedSpace>& solids);

}  // namespace bielle::mechanism
