// The periodic motion of a mechanism with a turning part: its mean state (mean_forces.hpp) with the vibrations that
// gravity across the axis and the unbalance of the part excite.
//
// The deviation from the mean state is a Fourier series in the azimuth (periodic_deviation.hpp). Newton's method on its
// coefficients solves the projected equations (harmonic balance):
//     mean of e_p(psi) r(psi) = 0,   p = 0 .. 2 h,
// where r is the residual of the nonlinear equations along the motion (orbit_equations.hpp), and its derivative are the
// linearised equations of the harmonics (harmonic_equations.hpp) for s = 0. The number of harmonics h follows from the
// convergence of the series, which is faster than any power of 1/h. (T. M. Cameron, J. H. Griffin, J. Appl. Mech. 56
// (1989) 149; A. Cardona, T. Coune, A. Lerusse, M. Geradin, IJNME 37 (1994) 1593.)
#pragma once

#include <optional>

#include "mechanism/solvers/linearised/periodic_deviation.hpp"
#include "mechanism/solvers/linearised/turning_part.hpp"

namespace bielle::mechanism {

struct PeriodicOrbit {
  PeriodicDeviation deviation;
  /// (unknowns, 2 h + 1) coefficients of the increments per second by which the motion goes on: a shift in time, which
  /// is a small motion with the exponent 0. Empty if a drive or a lock gives the angle of the joint.
  MatrixX shift;
  int moved = 0;            ///< the node that moves farthest from its place in the mean state
  double displacement = 0;  ///< its largest distance from there [m]
  double rotation = 0;      ///< largest rotation of a node from its orientation there [rad]
};

/// @param state  the mean state in steady rotation @param rate  of the joint's angle [rad/s]
/// @returns no value if the mean state is itself a motion: no force alternates
/// @throws ComputationError if no periodic motion is found
std::optional<PeriodicOrbit> find_periodic_orbit(const System& system, const Environment& environment,
                                                 const State& state, const TurningPart& part, double rate);

}  // namespace bielle::mechanism
