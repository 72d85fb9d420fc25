// Velocities that satisfy the derivatives of the constraints.
//
//   [M B^T; B 0][dv; mu] = [0; -dPhi/dt]
//
// dv is the smallest change in the norm of the kinetic energy: constraints that become active stop relative motion by
// an inelastic impulse.
#pragma once

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Projects the state's velocities on the constraints.
/// @param saddle  contains the factors of these positions afterwards
void make_velocities_consistent(const System& system, const Environment& environment, State& state, StartReport& report,
                                KktMatrix& saddle);

}  // namespace bielle::mechanism
