// The linearised equations of a mechanism with a turning part (turning_part.hpp) over one turn.
//
// The same mean state is turned to equidistant azimuths psi of the part. At each, u contains increments in axes that
// turn with the part for its nodes, and inertial ones for the others; rows of constraints are combined such that their
// entries at the turning nodes do not depend on psi. Coefficients that still depend on psi are those by which the
// standing and the turning part act on each other.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"
#include "mechanism/solvers/linearised/turning_part.hpp"

namespace bielle::mechanism {

/// The mechanism at one azimuth.
struct Azimuth {
  State state;                    ///< the mean state, turned, with its multipliers
  LinearisedEquations equations;  ///< W is the same for all azimuths
  /// (n, n) increments in the unknowns of the system for unit increments in turning axes: u = axes y.
  LinearisedEquations::Sparse axes;
  /// (constraints, constraints) combination of the rows of the system; multipliers are lambda = rows^T l.
  LinearisedEquations::Sparse rows;
};

/// @param state  the mean state in steady rotation @param count  number of azimuths
/// @returns the mechanism at psi = 2 pi k / count
/// @throws ComputationError if the turned state is no equilibrium: if some force depends on the azimuth
std::vector<Azimuth> azimuths_over_turn(const System& system, const Environment& environment, const State& state,
                                        const TurningPart& part, int count);
/// Returns their equations alone.
std::vector<LinearisedEquations> equations_over_turn(const System& system, const Environment& environment,
                                                     const State& state, const TurningPart& part, int count);

}  // namespace bielle::mechanism
