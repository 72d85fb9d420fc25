// Slow motions of equations with periodic coefficients by their monodromy matrix (G. Floquet, Ann. Sci. Ec. Norm. Sup.
// 12 (1883) 47).
//
// The states after one turn (turn_integration.hpp) of unit states are the monodromy matrix. An eigenvalue mu of it
// belongs to the exponents s = log(mu)/T + i k rate; the harmonics of its motion over the turn tell which of them is
// the principal one. All motions are found at once, whatever the number of their harmonics. Exponents have the accuracy
// of the time integration, some 1e-6 of the fastest one: continue_modes makes them accurate.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/solvers/linearised/harmonic_continuation.hpp"

namespace bielle::mechanism {

/// Finds the slowest motions besides the rigid ones, with as many harmonics as they need.
/// @param known  modes with few harmonics, whose rigid modes are taken over
/// @returns nothing if some of these motions may be missing: they decay so fast that nothing is left of them after a
/// turn, or there are slow motions next to rigid ones, or the rotation is so slow that a turn has too many steps
std::optional<HarmonicModes> find_by_monodromy(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                               const HarmonicModes& known, const ModeOptions& options);

}  // namespace bielle::mechanism
