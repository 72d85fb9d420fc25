// Penetration depth of the cores of two shapes: boxes without their rounding, lines of capsules.
//
// Both cores are Minkowski sums of line segments around a middle (three for a box, one for a capsule). The set of
// translations of one core that make it touch the other is therefore a zonotope around the difference of the middles,
// whose faces are normal to the products g_i x g_j of the segments of both. The shortest translation that separates
// them is
//     min over faces n of  sum_k |n . g_k| - |n . d|,       d from the first middle to the second,
// exactly, and the cores are apart if it is negative (S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, SIGGRAPH 1996, for
// boxes). Two capsules are only two lines, which have no interior.
#pragma once

#include <optional>

#include "mechanism/contacts/pair_touches.hpp"

namespace bielle::mechanism {

struct CoreOverlap {
  double depth;    ///< length of the shortest translation that separates the cores [m]
  Vector3 normal;  ///< direction in which the second core has to move
  Vector3 place;   ///< a point within both, or nearly so
};

/// Returns the overlap of two cores; nothing if they are apart, or if one of them is neither a box nor a capsule.
std::optional<CoreOverlap> overlap_of_cores(const PlacedShape<double>& first, const PlacedShape<double>& second);

/// Finds the point of an edge from a to b that is nearest to a core, or deepest within it: its distance is a convex
/// function along the edge, and ternary search is used.
/// @param skin  skin around the edge [m] @param edge_on_second  whether the edge is on the second shape and the core
/// belongs to the first
Touch<double> deepest_of_edge(const Triple<double>& a, const Triple<double>& b, double skin,
                              const PlacedShape<double>& core, bool edge_on_second);

}  // namespace bielle::mechanism
