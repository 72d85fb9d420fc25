// Constraints that repeat what others hold already: found, named and set aside.
//
// A planar mechanism of hinges, closed in space, is the everyday case. The search finds those columns of B^T (one per
// multiplier, scaled to length one, translations in arms of the constraints) that depend on others before them in
// the file (math/rank.hpp). Their rows leave the equations and their multipliers stay zero: the motion is unaffected.
// Reported are the reactions of smallest norm (reaction_norm.hpp).
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Multipliers whose constraint depends on earlier ones at this state, ascending.
/// @param least  how far from dependent counts as such: 0 for rounding; sines of angles between constraints [-]
std::vector<int> find_redundant(const System& system, const Environment& environment, const State& state,
                                double least = 0);

/// The state with its redundant constraints in the equations.
State with_redundant(const System& system, const State& state);

/// The length L by which moments are compared with forces: the longest arm at which a component's constraints act about
/// its nodes [m], redundant ones included.
double redundancy_arm(const System& system, const Environment& environment, const State& state);

/// Takes what is redundant where a motion is to begin out of the equations, for good or, where constraints can be
/// switched, for as long as it is redundant. Call before solvers are made.
/// @param state  as System::start gives it
/// @returns multipliers, ascending
std::vector<int> take_out_redundant(System& system, const Environment& environment, State& state);

/// How a mechanism can move where a motion begins.
struct Mobility {
  int degrees = 0;      ///< of freedom, amplitudes included
  int independent = 0;  ///< constraints
  /// Constraints that differ from what others hold by less than a thousandth (sines of angles between constraints):
  /// meant to repeat them, perhaps. By joint, as name_constraints().
  std::vector<std::string> nearly_redundant;
};

/// @param state  with the redundant constraints taken out
Mobility count_mobility(const System& system, const Environment& environment, const State& state);

/// Where constraints can be switched (System::switches): marks those that repeat others among the ones that are on, and
/// takes the marks from the others.
void set_redundant_aside(const System& system, const Environment& environment, State& state);

/// What to say of a position in which a step fails, if constraints nearly repeat others there that did not at the
/// start; or nothing.
std::string describe_singularity(const System& system, const Environment& environment, const State& state);

/// A sentence where constraints that are set aside only look redundant: because the mechanism stands in a singular
/// position, which it may leave in more than one way. Otherwise nothing.
std::string describe_singular_start(const System& system, const Environment& environment, const State& state);

/// The constraints of ascending multipliers in the user's terms, one text per joint: "x, y, rz of joint 'crank'".
std::vector<std::string> name_constraints(const System& system, const std::vector<int>& multipliers);

/// Checks that constraints set aside hold all the same.
/// @throws ComputationError naming one that does not: it contradicts the others (a drive on a joint that cannot move),
/// or
///         is no longer redundant in this position
void check_set_aside(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
