// How far the cores of two shapes have gone into each other: boxes without their rounding, the line of a capsule.
//
// Both cores are sums of line segments around a middle (a box of three, a capsule of one), and so is what one has to be
// moved by, in any direction, to touch the other: a zonotope around the difference of the middles, whose faces are
// normal to the products g_i x g_j of the segments of both. The shortest way that parts them is
//     min over faces n of  sum_k |n . g_k| - |n . d|,       d from the first middle to the second,
// exactly, and they are apart if it is negative (S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, SIGGRAPH 1996, for
// boxes). Two capsules are no more than two lines, which have no inside.
#pragma once

#include <optional>

#include "mechanism/contacts/pair_touches.hpp"

namespace bielle::mechanism {

struct CoreOverlap {
  double depth;    ///< the shortest way that parts the cores [m]
  Vector3 normal;  ///< along which the second has to go
  Vector3 place;   ///< within both, or nearly so
};

/// Nothing where the cores are apart, or are not both of boxes and capsules.
std::optional<CoreOverlap> overlap_of_cores(const PlacedShape<double>& first, const PlacedShape<double>& second);

/// The place of an edge from a to b that is nearest to a core, or deepest within it: its distance is a convex function
/// along the edge, searched by thirds.
/// @param skin  around the edge [m] @param edge_on_second  the core belongs to the first shape
Touch<double> deepest_of_edge(const Triple<double>& a, const Triple<double>& b, double skin,
                              const PlacedShape<double>& core, bool edge_on_second);

}  // namespace bielle::mechanism
