// One-sided constraints that depend on each other or on drives: one-way clutches in series, a drive that moves a
// pawled wheel on.
//
// Such constraints are set aside as if they were redundant (they yield), the last in the file first. Their coordinates
// may then move: in the free direction, where they open, or against it. In the latter case the constraint must hold,
// and another one of the dependent ones is free instead. Forces decide as well: if three clutches stop two parts, those
// that push must hold. A set of active constraints is sought in which no constraint that is set aside is violated, and
// no active one pulls. If there is no such set, constraints that pull open by their own events.
// Complementarity: F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts (1996), chapter 6.
#pragma once

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Begins with another set of active one-sided constraints if some are set aside, and motions or forces have wrong
/// signs.
/// @param begun   state before its velocities and accelerations were made consistent
/// @param made    the same state with consistent velocities and accelerations; those of the other set afterwards
/// @param report  receives the changes of velocities with the other set
/// @param saddle  its factors belong to the set that is used
/// @returns whether there is another set: not if this one is right, or if none is better
/// @throws ComputationError naming a violated constraint if all sets have one
bool exchange_one_sided(const System& system, const Environment& environment, const State& begun, State& made,
                        StartReport& report, KktMatrix& saddle);

}  // namespace bielle::mechanism
