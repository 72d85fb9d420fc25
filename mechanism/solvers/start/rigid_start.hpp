// Joints that carry all parts behind them at the start of a motion (CarriedStart): these move as one rigid body.
//
// The joint's other side has the velocity v_b and the angular velocity omega_b of its node. The part behind the joint
// gets
//     v = v_b + omega_b x (x - x_b) + u + w x (x - p),     omega = omega_b + w,
// with the twist (u, w) at the place p of the moving node that satisfies, in this order, the joint's own constraints,
// drives and locks of its coordinates, and their start rates; all other coordinates and motions are at rest. Joints
// behind joints are set from the outermost inwards, each in addition to the others. Inner nodes of beams and interfaces
// of superelements are treated like other nodes; modal amplitudes are relative to the body's frame: they are at rest.
#pragma once

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Sets the velocities at the start of a motion: those due to carrying joints, given velocities, both made consistent
/// with the constraints, and start rates, in that order.
/// @param state  state with positions that satisfy the constraints
/// @throws ComputationError as set_start_rates(); and naming a joint whose part is connected to the other side, a
/// constraint that prevents the motion, or a node that is given another velocity
void begin_velocities(const System& system, const Environment& environment, State& state,
                      const StartConditions& conditions, StartReport& report);

}  // namespace bielle::mechanism
