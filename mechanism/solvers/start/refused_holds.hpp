// Holds that the other constraints refuse.
//
// A hold is a switched constraint that yields to others (Declaration::Scalar::yields): friction that sticks. It begins
// where its rate is zero. Where the mechanism as a whole comes to rest there, the hold needs no impulse. But a joint of
// a loop also comes to rest at its own dead centre, from which the rest of the loop moves it on: to hold it there would
// stop the whole mechanism by an impulse that no friction gives. The two are told apart by forces: velocities stay
// those without the new holds, and the accelerations with them say what each would have to bear. A hold is refused that
//     - is overloaded then (a crossing that lets go `one_by_one` is negative): the most overloaded first;
//     - leaves no accelerations, or more than one solution, where forces depend on reactions: the last that
//     is given first.
// It is set aside as if it were redundant, its multiplier zero. If its coordinate accelerates, its component begins to
// slide at once, in the direction of the acceleration.
#pragma once

#include <vector>

#include "mechanism/solvers/constraints/mass_saddle.hpp"

namespace bielle::mechanism {

/// Holds that are in force at a state.
std::vector<int> active_holds(const System& system, const State& state);

/// Whether new holds stop more than what has come to rest by itself: where one does, the joint is at a dead centre, or
/// all that it is joined to comes to rest. In chains without loops none does.
bool holds_stop_more(const System& system, const Environment& environment, const State& state,
                     const std::vector<int>& new_holds, MassSaddle& saddle);

/// What becomes of new holds that are overloaded. Where they stop nothing they hold as yet, and let go later, one by
/// one.
enum class Overloaded { refused, holds };

/// Sets holds aside that cannot begin at a state. Afterwards velocities and accelerations are to be made consistent.
/// @param state    with its redundant constraints set aside
/// @param new_holds  those that may be refused: that have just come into force
/// @param saddle   its factors are those of other constraints afterwards
/// @throws ComputationError where there are no accelerations, whatever holds
void refuse_holds(const System& system, const Environment& environment, State& state, std::vector<int> new_holds,
                  Overloaded overloaded, MassSaddle& saddle);

}  // namespace bielle::mechanism
