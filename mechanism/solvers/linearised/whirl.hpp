// Sense of whirl of a mode about an axis.
//
// Each node's displacement and tilt normal to the axis, with complex amplitudes a and b along two directions that form
// a right-handed frame with it, moves along an ellipse: forwards (about the axis) if Im(conj(a) b) < 0 with the factor
// exp(i w t), w > 0, backwards if it is positive. The whirl of a mode is
//     -2 sum m Im(conj(a) b) / sum m (|a|^2 + |b|^2)
// The sums are over translations and rotations of all nodes, with their inertias m: the result is 1 for forward
// circles, -1 for backward circles, 0 for motions in a plane.
#pragma once

#include <optional>

#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

/// @param axis  unit vector, inertial @param M  the mass matrix of the linearised equations
/// @returns no value if less than a tenth of the motion is normal to the axis (torsion, motions along it)
std::optional<double> whirl_of(const System& system, const State& state, const LinearisedEquations::Sparse& M,
                               const Mode& mode, const Vector3& axis);

}  // namespace bielle::mechanism
