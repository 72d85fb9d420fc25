// Joints that carry all that is behind them where a motion begins (CarriedStart): it moves as one rigid body.
//
// The joint's other side has the velocity v_b and the angular velocity omega_b of its node. The part behind gets
//     v = v_b + omega_b x (x - x_b) + u + w x (x - p),     omega = omega_b + w,
// with the twist (u, w) at the place p of the moving node that satisfies, in this order, the joint's own constraints,
// drives and locks of its coordinates, and the start rates of these; coordinates of which nothing is said are at rest,
// and so is what no coordinate tells. Joints behind joints are set from the outermost inwards, each on top of the
// others. Inner nodes of beams and interfaces of superelements are nodes like others; modal amplitudes count in the
// body's frame: they rest.
#pragma once

#include "mechanism/solvers/constraints/mass_saddle.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Velocities with which a motion begins: what joints carry, velocities as given, both consistent with the constraints,
/// and start rates, in that order.
/// @param state  with positions that satisfy the constraints
/// @throws ComputationError as set_start_rates(); and naming a joint that carries what is joined back to the other
/// side, what a constraint does not let move so, or a node that is given another velocity
void begin_velocities(const System& system, const Environment& environment, State& state,
                      const StartConditions& conditions, StartReport& report);

}  // namespace bielle::mechanism
