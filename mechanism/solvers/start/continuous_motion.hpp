// Consecutive positions of a mechanism with prescribed motion: whether they belong to one continuous motion.
#pragma once

#include <functional>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the state a time later or earlier, from its velocities and accelerations: an initial guess of the next
/// position.
State predicted(const System& system, const State& state, double time);

/// Velocities that differ from the integral of their accelerations belong to another branch, which is possible if a
/// dead centre is met exactly. A step whose velocities do not fit is halved recursively: a smooth motion finally fits,
/// or changes so little that the difference is negligible. A step that is large relative to the distance between two
/// branches may lead to the other one although velocities fit: if the sides of singular positions are known
/// (branch_sign.hpp), a step that changes them is halved as well, until it is so short that it must have passed a
/// singular position.
class ContinuousMotion {
 public:
  /// Computes the state at a time, from another state's positions and rates.
  using Position = std::function<State(const State& from, double time)>;
  /// Whether two states are on the same side of singular positions.
  using SameSide = std::function<bool(const State& one, const State& other)>;
  ContinuousMotion(const System& system, Position position, SameSide same_side)
      : system_(system), position_(std::move(position)), same_side_(std::move(same_side)) {}

  /// Advances the state to a later time. @param jumps  velocities may jump at that time (a kink of a drive's law)
  /// @throws ComputationError if they jump elsewhere
  State advance(const State& from, double time, bool jumps);

 private:
  State advance(const State& from, double time, bool jumps, int depth);
  State advance_in_halves(const State& from, double time, bool jumps, int depth);
  /// Returns whether the velocities of two states agree with their accelerations by the trapezoidal rule.
  bool fits(const State& from, const State& to);

  const System& system_;
  Position position_;
  SameSide same_side_;
  double fastest_ = 0;  ///< largest velocity so far, relative to the model's extent [1/s]
};

}  // namespace bielle::mechanism
