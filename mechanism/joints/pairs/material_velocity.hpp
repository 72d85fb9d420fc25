// The relative velocity of the material of two nodes at a point that moves in both of them: slip of wheels and tyres.
#pragma once

#include <array>

#include "mechanism/measures/pair_measure.hpp"

namespace bielle::mechanism {

/// Three numbers that depend on the positions: components of an axis or of a lever arm.
using VectorJet = std::array<PairMeasure, 3>;

inline Vector3 value_of(const VectorJet& jet) { return {jet[0].value, jet[1].value, jet[2].value}; }

/// Multiplies a vector by constant axes.
VectorJet turned(const Matrix3& axes, const VectorJet& vector);

/// Velocity of the material of node 2 at the arm c, relative to node 1's material at the same place, along the axis e
/// [m/s]: the gradient w of the position measure at the present e and c, and its change dw while they vary. The value
/// is w . v.
/// @param e  axis, components along node 1 @param c  arm, components along node 2 [m]
PairMeasure material_velocity(const NodeState& first, const NodeState& second, const VectorJet& e, const VectorJet& c);

}  // namespace bielle::mechanism
