// Redundant constraints: they are found, named and set aside.
//
// The most frequent case is a planar mechanism of hinges with a closed loop in space. The search finds those columns of
// B^T (one per multiplier, scaled to length one, translations in arms of the constraints) that depend on columns before
// them in the file (math/rank.hpp). Their rows are removed from the equations and their multipliers stay zero: the
// motion is unaffected. The reported reactions are those of smallest norm (reaction_norm.hpp).
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the multipliers whose constraints depend on earlier ones at this state, ascending.
/// @param least  largest distance from dependence that counts as dependent: 0 for rounding; sines of angles between
///               constraints [-]
std::vector<int> find_redundant(const System& system, const Environment& environment, const State& state,
                                double least = 0);

/// Returns the state with its redundant constraints in the equations.
State with_redundant(const System& system, const State& state);

/// Returns the length L by which moments are compared with forces: the longest lever arm at which a component's
/// constraints act on its nodes [m], including redundant ones.
double redundancy_arm(const System& system, const Environment& environment, const State& state);

/// Removes redundant constraints from the equations at the start of a motion, permanently or, if constraints can be
/// switched, for as long as they are redundant. Call this function before solvers are created.
/// @param state  state returned by System::start
/// @returns multipliers of the removed constraints, ascending
std::vector<int> take_out_redundant(System& system, const Environment& environment, State& state);

/// Mobility of a mechanism at the start of a motion.
struct Mobility {
  int degrees = 0;      ///< degrees of freedom, amplitudes included
  int independent = 0;  ///< number of independent constraints
  /// Constraints that differ from a combination of others by less than a thousandth (sines of angles between
  /// constraints), and may be intended as redundant. They are listed by joint, as by name_constraints().
  std::vector<std::string> nearly_redundant;
};

/// @param state  state with the redundant constraints taken out
Mobility count_mobility(const System& system, const Environment& environment, const State& state);

/// If constraints can be switched (System::switches): marks the redundant ones among those that are on, and removes the
/// marks of the others.
void set_redundant_aside(const System& system, const Environment& environment, State& state);

/// Describes a position in which a step fails, if constraints are nearly redundant there that were not at the start;
/// otherwise empty.
std::string describe_singularity(const System& system, const Environment& environment, const State& state);

/// Returns a sentence if constraints that are set aside only seem redundant, because the mechanism is in a singular
/// position, which it may leave in more than one way. Otherwise it is empty.
std::string describe_singular_start(const System& system, const Environment& environment, const State& state);

/// Describes the constraints of ascending multipliers, one text per joint: "x, y, rz of joint 'crank'".
std::vector<std::string> name_constraints(const System& system, const std::vector<int>& multipliers);

/// Checks that constraints set aside are nevertheless satisfied.
/// @throws ComputationError naming a constraint that is not: it contradicts the others (a drive on a joint that cannot
/// move), or
///         is no longer redundant in this position
void check_set_aside(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
