// Indifferent motions (a free shaft), held in place for Newton's method.
#pragma once

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

/// Adds a stiffness against displacements that is a small fraction of centrifugal forces. Rates must not be included,
/// or the Coriolis forces of an eccentric rotor that moves outwards would rotate its free shaft far. Unknowns without
/// inertia are held as strongly as the others. @param rate  of the rotation [rad/s]
void hold_loose(double rate, LinearisedEquations& equations);

}  // namespace bielle::mechanism
