// Holds that contradict the other constraints.
//
// A hold is a switched constraint that yields to others (Declaration::Scalar::yields): sticking friction. It begins
// when its rate is zero. If the whole mechanism comes to rest at this time, the hold needs no impulse. But a joint of a
// loop also comes to rest at its own dead centre, from which the rest of the loop moves it on: a hold there would stop
// the whole mechanism by an impulse that friction cannot exert. The two cases are distinguished by forces: velocities
// are those without the new holds, and the accelerations with the holds give their forces. A hold is rejected if it
//     - is overloaded (a `one_by_one` event function is negative): the most overloaded first;
//     - leaves no accelerations, or more than one solution, with forces that depend on reactions: the last in
//     the list first.
// It is set aside as if it were redundant, with a multiplier of zero. If its coordinate accelerates, its component
// begins to slide immediately, in the direction of the acceleration.
#pragma once

#include <vector>

#include "mechanism/solvers/constraints/kkt_matrix.hpp"

namespace bielle::mechanism {

/// Returns the active holds of a state.
std::vector<int> active_holds(const System& system, const State& state);

/// Returns whether new holds stop more than the coordinates that have come to rest. If one does, the joint is at a dead
/// centre, or all connected parts come to rest. This is never the case in chains without loops.
bool holds_stop_more(const System& system, const Environment& environment, const State& state,
                     const std::vector<int>& new_holds, KktMatrix& saddle);

/// Treatment of overloaded new holds. If they stop no motion they engage first, and are released later, one by one.
enum class Overloaded { refused, holds };

/// Sets holds aside that cannot begin at a state. Velocities and accelerations must be made consistent afterwards.
/// @param state    state with its redundant constraints set aside
/// @param new_holds  holds that may be rejected, because they have just engaged
/// @param saddle   its factors belong to other constraints afterwards
/// @throws ComputationError if there are no accelerations for any set of holds
void refuse_holds(const System& system, const Environment& environment, State& state, std::vector<int> new_holds,
                  Overloaded overloaded, KktMatrix& saddle);

}  // namespace bielle::mechanism
