// The relative velocity of the material of two nodes at a point that moves in both of them: slip of wheels and tyres.
#pragma once

#include <array>

#include "mechanism/measures/pair_measure.hpp"

namespace bielle::mechanism {

/// Three numbers that depend on the positions: components of an axis or of a lever arm.
template <int order>
using PairVector = std::array<PairMeasureOf<order>, 3>;

template <int order>
Vector3 value_of(const PairVector<order>& vector) {
  return {vector[0].value, vector[1].value, vector[2].value};
}

// The following functions exist for orders 1 and 2.

/// Multiplies a vector by constant axes.
template <int order>
PairVector<order> turned(const Matrix3& axes, const PairVector<order>& vector);

/// Computes the velocity of the material of node 2 at the arm c, relative to node 1's material at the same place, along
/// the axis e [m/s]: the gradient w of the position measure at the present e and c, and its change dw while they vary.
/// The value is w . v.
/// @param e  axis, components along node 1 @param c  arm, components along node 2 [m]
template <int order>
PairMeasureOf<order> material_velocity(const NodeState& first, const NodeState& second, const PairVector<order>& e,
                                       const PairVector<order>& c);

}  // namespace bielle::mechanism
