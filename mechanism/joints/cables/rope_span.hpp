// The straight part of a rope between two pulleys, and the length of rope that is wound on them.
//
// Pulley k has its centre p_k and its axis z_k on a node, and a radius rho_k with a sign: a rope that travels from
// pulley i to pulley j rotates a pulley of positive radius about +z. (A point is a pulley of radius zero.) With d = p_j
// - p_i and the tangent's direction u, the rope touches pulley k at p_k + rho_k u x z, so that
//     l = sqrt(d . d - (rho_j - rho_i)^2),   angle from d to u about z:  gamma = atan2(rho_i - rho_j, l).
// alpha_k, the angle of d about z_k in the axes of pulley k, counts the rotation of the tangent point on the pulley's
// material over turns. Rope that has been unwound from i and not wound on j since the start makes the span longer
// without strain:
//     e = l + rho_i (alpha_i + gamma) - rho_j (alpha_j + gamma) - (initial value)
// is the elongation of a span without slip on both. Its gradient is the wrench of a unit tension on both bodies. Axes
// of pulleys are parallel, or nearly: an offset along them is included in l, not in the angles.
#pragma once

#include "mechanism/measures/coordinate.hpp"
#include "mechanism/measures/pair_measure.hpp"

namespace bielle::mechanism {

struct Pulley {
  Frame on_node;      ///< origin: its centre; z: its axis
  double radius = 0;  ///< signed radius [m]
};

/// A span at a state, along the increments of its two nodes.
template <int order>
struct SpanMeasures {
  PairMeasureOf<order> length;                   ///< l [m]
  PairMeasureOf<order> first_turn, second_turn;  ///< alpha_i + gamma, alpha_j + gamma; alpha in (-pi, pi] [rad]
};

/// Exists for orders 1 and 2.
template <int order>
SpanMeasures<order> measure_span(const NodeState& first, const NodeState& second, const Pulley& from, const Pulley& to);

}  // namespace bielle::mechanism
