// Positions of a mechanism whose motion is prescribed, one after the other: whether they belong to one motion.
#pragma once

#include <functional>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// The state a time later or earlier, by its velocities and accelerations: where the search for a position begins.
State predicted(const System& system, const State& state, double time);

/// Velocities that jump against their accelerations are those of another branch, as a dead centre that is met exactly
/// leaves it open. A step whose velocities do not fit is halved, and its halves likewise: what is smooth fits in the
/// end, or changes so little that nobody can see it. A step that is large against the way between two branches may lead
/// to the other one although velocities fit: where the sides of singular positions are known (branch_sign.hpp), a step
/// that changes them is halved as well, until it is so short that it must have passed a singular position.
class ContinuousMotion {
 public:
  /// The state of a time, searched for from another state's positions and rates.
  using Position = std::function<State(const State& from, double time)>;
  /// Whether two states are on the same side of singular positions.
  using SameSide = std::function<bool(const State& one, const State& other)>;
  ContinuousMotion(const System& system, Position position, SameSide same_side)
      : system_(system), position_(std::move(position)), same_side_(std::move(same_side)) {}

  /// The state of a later time. @param jumps  velocities may jump at that time (a kink of a drive's law)
  /// @throws ComputationError where they jump elsewhere
  State advance(const State& from, double time, bool jumps);

 private:
  State advance(const State& from, double time, bool jumps, int depth);
  State advance_in_halves(const State& from, double time, bool jumps, int depth);
  /// Whether the velocities of two states fit to their accelerations by the trapezoidal rule.
  bool fits(const State& from, const State& to);

  const System& system_;
  Position position_;
  SameSide same_side_;
  double fastest_ = 0;  ///< velocity so far, relative to the model's extent [1/s]
};

}  // namespace bielle::mechanism
