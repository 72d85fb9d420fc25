// The sense in which a mode whirls about an axis.
//
// Each node's displacement and tilt across the axis, with complex amplitudes a and b along two directions that form a
// right-handed frame with it, goes round an ellipse: forwards (about the axis) where Im(conj(a) b) < 0 as exp(i w t)
// with w > 0 carries it, backwards where it is positive. The whirl of a mode is
//     -2 sum m Im(conj(a) b) / sum m (|a|^2 + |b|^2)
// over translations and rotations of all nodes, m their inertias: 1 of circles forwards, -1 of circles backwards, 0 of
// motions in a plane.
#pragma once

#include <optional>

#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

/// @param axis  unit vector, inertial @param M  the mass matrix of the linearised equations
/// @returns nothing where less than a tenth of the motion is across the axis (torsion, motions along it)
std::optional<double> whirl_of(const System& system, const State& state, const LinearisedEquations::Sparse& M,
                               const Mode& mode, const Vector3& axis);

}  // namespace bielle::mechanism
