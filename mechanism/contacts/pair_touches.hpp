// Where two shapes touch: the places at which they press into each other, and the elastic force at each.
//
// The corners of either core are compared with the other shape as a whole, and the edges of the cores with each other
// where they cross. Corners of a cylinder are its two ends, flat domes; its edge is its axis with its radius for a skin
// (pair_of_shapes.hpp). Of a surface of triangles the tips and ridges take the place of corners and edges; a corner
// of the other shape touches it in one place or several (on_surface.hpp). Two skins of thicknesses r_1, r_2 around
// cores at the distance d press into each other by p = r_1 + r_2 - d. The elastic potential of the pair, V(p) = k
// p^(n+1)/(n+1), is
//     sum over corners of V(p_j)  +  sum over crossing edges of V(p_e) prod_i (1 - V(p_i)/V(p_e)),
// i the four ends of the two edges, each against the other edge, p_i <= p_e. An edge on which another slides to its end
// thus hands over to its corner without a jump; of two that are parallel, the ends bear alone. An end against the side
// of a cylinder is compared with the cylinder as a whole. Forces are derivatives of the potential: along the normal at
// each place, and continuous.
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
  T depth{};         ///< p [m]
  Triple<T> normal;  ///< from the first shape to the second
  Triple<T> place;   ///< halfway between the two surfaces
  T force{};         ///< elastic, along the normal on the second [N]; may be negative where edges share with corners
  T load{};          ///< what damping and friction follow: >= 0 [N]
  int id = 0;  ///< the same from step to step: which corner, which crossing; a corner may touch a surface several times
};

template <class T>
struct PairTouches {
  std::vector<Touch<T>> touches;
  T potential{};  ///< [J]
};

/// What presses at a relative position. Both shapes are given in the same axes.
/// @throws ComputationError where cores go through each other, so that no direction tells where they came from
template <class T>
void find_touches(const PlacedShape<T>& first, const PlacedShape<T>& second, const NormalLaw& law,
                  PairTouches<T>& result);

/// The smallest gap of the two, with its place and normal (depth = -gap); forces are not computed.
Touch<double> find_nearest_place(const PlacedShape<double>& first, const PlacedShape<double>& second);

}  // namespace bielle::mechanism
