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

/// A motion with one of its exponents.
struct FloquetMotion {
  std::complex<double> s;  ///< |Im s| <= rate/2, >= 0
  Eigen::MatrixXcd u, w;   ///< amplitudes of the unknowns and of the dofs' rates at harmonics -h .. h (columns)
};

/// Finds the motions, one of each conjugate pair, without those that vanish in a turn and those that are too fast.
/// @param fastest  rate up to which motions are resolved [rad/s]
/// @param angle  phase by which such a motion advances in a step [rad]: its exponent has a relative error of 1.4e-4
/// angle^5
/// @throws ComputationError if the equations of a step are singular, a turn has too many steps, or a motion grows by a
/// factor of 1e4 in it
std::vector<FloquetMotion> floquet_motions(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                           double fastest, double angle);

constexpr double coarse_angle = 0.4;  ///< sufficient as a start for continue_modes

/// Whether a motion decays so much in a turn that the monodromy matrix does not show it.
bool vanishes_in_turn(std::complex<double> s, double rate);

/// Returns the amplitudes of the harmonics -h .. h, zeros for those that are not given.
Eigen::MatrixXcd within(const Eigen::MatrixXcd& amplitudes, int h);

/// Raises the number of harmonics until nearly everything of each motion lies within them, and leaves out the others.
void keep_necessary_harmonics(const HarmonicShapes& shapes, double rate, HarmonicModes& modes);

/// The motions up to a rate with their principal exponents, and the number of those that may be zero.
struct PrincipalModes {
  std::vector<HarmonicMode> modes;
  int near_zero = 0;
};

/// Finds the motions that the monodromy matrix shows, at least as many as are asked for.
/// @returns nothing if floquet_motions throws, or for a search near a frequency
std::optional<PrincipalModes> find_by_monodromy(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                                const ModeOptions& options);

/// Chooses the slowest modes, with as many harmonics as they need.
/// @param known  modes with few harmonics, from which rigid modes and motions that vanish in a turn are taken
/// @returns nothing if there are slow motions next to rigid ones, or too many harmonics are necessary
std::optional<HarmonicModes> slowest_modes(PrincipalModes principal, const HarmonicModes& known,
                                           const HarmonicShapes& shapes, double rate, const ModeOptions& options);

}  // namespace bielle::mechanism
