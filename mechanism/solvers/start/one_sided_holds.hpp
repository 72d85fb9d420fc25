// One-sided constraints that depend on each other or on drives: one-way clutches in series, a drive that moves a
// pawled wheel on.
//
// Such constraints are set aside as if they were redundant (they yield), the last in the file first. Their coordinates
// may then move: in the free direction, where they open, or against it. In the latter case the constraint must hold,
// and another one-sided constraint of the dependent ones is free instead. Which one it is follows from the
// velocities and accelerations: a set of active constraints is sought with which no constraint that is set aside is
// violated. Active ones whose force has the wrong sign open afterwards, by their own events.
// Complementarity: F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts (1996), chapter 6.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/solvers/constraints/kkt_matrix.hpp"

namespace bielle::mechanism {

/// Seeks another set of active one-sided constraints if one that is set aside is violated.
/// @param begun   state before its velocities and accelerations were made consistent
/// @param made    the same state with consistent velocities and accelerations
/// @param saddle  its factors belong to other constraints afterwards, if there is another set
/// @returns flags of the constraints (State::idle) from which to begin instead; nothing if no constraint is violated
/// @throws ComputationError naming a violated constraint if there is no such set
std::optional<std::vector<char>> exchange_one_sided(const System& system, const Environment& environment,
                                                    const State& begun, const State& made, KktMatrix& saddle);

}  // namespace bielle::mechanism
