// Modes about a periodic motion, searched for around the exponents of the mean equations.
//
// At a slower rotation the copies of a motion are closer together, and a motion whose frequency is modulated over a
// turn has more harmonics. Its shape is then a sum of copies of modes of the mean equations. It represents the mode of
// the mean equations that has the largest part in it, with the copy in which the mean of the harmonics of this mode is
// nearest to zero: its exponent is next to the mean of the modulated frequency.
#pragma once

#include "mechanism/solvers/linearised/harmonic_continuation.hpp"

namespace bielle::mechanism {

/// @param mean  modes of the mean equations, none of them rigid
/// @returns for each of them one mode of the equations of the harmonics; nothing if one of them is not found
std::optional<HarmonicModes> find_modes_around(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                               const HarmonicModes& mean, int harmonics);

/// Finds the same among the motions that the monodromy matrix shows (floquet_motions.hpp), with as many harmonics as
/// they need, and without the equations of these. Modes of the mean equations that vanish in a turn are returned as
/// they are.
/// @param angle  as for floquet_motions
std::optional<HarmonicModes> find_modes_over_turn(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                                  const HarmonicModes& mean, double angle);

}  // namespace bielle::mechanism
