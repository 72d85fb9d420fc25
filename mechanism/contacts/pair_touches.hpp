// Contact of two shapes: the places at which they penetrate each other, and the elastic force at each.
//
// The corners of either core are compared with the other shape as a whole, and the edges of the cores with each other
// where they cross. Corners of a cylinder are its two ends, flat domes; its edge is its axis with its radius for a skin
// (pair_of_shapes.hpp). For a surface of triangles, tips and ridges replace corners and edges; a corner of the other
// shape may touch it at several places (on_surface.hpp). Two skins of thicknesses r_1, r_2 around cores at the distance
// d have the penetration p = r_1 + r_2 - d. The elastic potential of the pair, V(p) = k p^(n+1)/(n+1), is
//     sum over corners of V(p_j)  +  sum over crossing edges of V(p_e) prod_i (1 - V(p_i)/V(p_e)),
// The index i counts the four ends of the two edges, each with the other edge, and p_i <= p_e. An edge on which another
// slides to its end thus transfers the force to its corner continuously; for parallel edges, only the ends bear. An end
// on the side of a cylinder is compared with the cylinder as a whole. Forces are derivatives of the potential: along
// the normal at each place, and continuous.
#pragma once

#include <vector>

#include "mechanism/contacts/shape.hpp"
#include "mechanism/contacts/triple.hpp"
#include "mechanism/laws/normal_law.hpp"

namespace bielle::mechanism {

template <class T>
struct PlacedShape {
  const ContactShape* shape = nullptr;
  Triple<T> origin;
  std::array<Triple<T>, 3> axes;
};

template <class T>
struct Touch {
  T depth{};         ///< penetration p [m]
  Triple<T> normal;  ///< unit vector from the first shape to the second
  Triple<T> place;   ///< halfway between the two surfaces
  /// Elastic force on the second along the normal [N]; may be negative if an edge and its corners share the force.
  T force{};
  T load{};  ///< normal force that scales damping and friction, >= 0 [N]
  /// Number of the corner or crossing, the same in all steps; several touches of a corner on a surface share it.
  int id = 0;
};

template <class T>
struct PairTouches {
  std::vector<Touch<T>> touches;
  T potential{};  ///< potential [J]
};

/// Finds the touches at a relative position. Both shapes are given in the same axes.
/// @throws ComputationError if cores penetrate each other so that the direction of separation is undetermined
template <class T>
void find_touches(const PlacedShape<T>& first, const PlacedShape<T>& second, const NormalLaw& law,
                  PairTouches<T>& result);

/// Finds the smallest gap of two shapes, with its place and normal (depth = -gap); it does not compute forces.
Touch<double> find_nearest_place(const PlacedShape<double>& first, const PlacedShape<double>& second);

}  // namespace bielle::mechanism
