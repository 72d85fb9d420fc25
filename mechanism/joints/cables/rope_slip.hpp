// Slip of a rope on a pulley with friction: the length s [m] of rope that has slid over the pulley in the direction of
// the rope, from the section before it to the section after it.
//
// Slip follows from a balance of tensions (rope_friction.hpp), relative to the slip s_0 at the end of the last accepted
// step, at the time t_0: it is an algebraic unknown with a memory, like a plastic strain. With the mean rate
// m = (s - s_0)/h over the present step of size h = t - t_0, and m_0 over the last one of size h_0, its rate at the end
// of the step is that of a parabola (the differentiation formula of second order),
//     ds/dt = m + (m - m_0) h/(h + h_0),
// but no less than zero in the direction of slip, so that a rope does not slip back. It is m if the rope slipped in the
// other direction, or if there is a discontinuity between the steps. This rate serves damping, powers and results. The
// slip of a damped rope has a rate as well at the beginning of a branch: it follows from the same balance, with the
// slip fixed. This rate is a second algebraic unknown, which equals ds/dt at other times.
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class RopeSlip final : public Component {
 public:
  /// @param pulley  name of its node   @param length  initial length of the two sections next to it [m]
  /// @param damping  time constant of the rope's damping [s]
  RopeSlip(std::string type, std::string name, std::string pulley, double length, double damping);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  void activate(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  bool knows_memory(const LocalState& state) const override;

  // The following functions take the component's own local state.
  static double slip(const LocalState& own) { return own.first_order()[0]; }  ///< s [m]
  /// The unknown that follows from the balance of tensions at this state.
  struct Change {
    int unknown = 0;   ///< number of the unknown: 0: the slip, 1: its rate, at the beginning of a branch
    double value = 0;  ///< s - s_0 [m], or the rate [m/s]; zero if the rope sticks
  };
  static Change change(const LocalState& own);
  /// Returns the change of the present step, or of the last step at its end.
  static double last_change(const LocalState& own);
  struct Value {
    double value = 0;
    double by_change = 0;  ///< derivative by `change`
    double most = 0;       ///< upper bound of this derivative at any value
  };
  /// Returns the rate of the slip [m/s], which is zero in a static analysis and as long as the rope sticks.
  static Value rate(const LocalState& own);
  /// Tells whether the change is determined at this state: in a static analysis, within a step, and at the beginning of
  /// a branch if the rope is damped, or before the first motion.
  static bool may_change(const LocalState& own);
  /// Tells whether the first motion has begun: false at its beginning, and when an event activates the rope.
  static bool has_begun(const LocalState& own) { return !std::isnan(own.memory()[time_memory]); }
  /// Returns 1/h [1/s], or zero outside of steps.
  static double per_time(const LocalState& own);
  /// Tells whether this is the beginning of a branch, at which the rate is determined.
  static bool rate_begins(const LocalState& own);
  /// Returns s - s_0 [m].
  static double increment(const LocalState& own) { return slip(own) - own.memory()[slip_memory]; }
  /// Returns the second unknown [m/s].
  static double rate_unknown(const LocalState& own) { return own.first_order()[1]; }

 private:
  // Phases: smooth: the last step belongs to the same branch; first_step: it does not; begins: the rate at which the
  // branch begins is not yet known.
  static constexpr double smooth = 0, first_step = 1, begins = 2;
  // Memory: s_0, t_0 (NaN before the first motion or static analysis), mean rate and length of the last step, rate at
  // its end, phase.
  enum : Eigen::Index { slip_memory, time_memory, mean_memory, step_memory, rate_memory, phase_memory, memories };
  /// Returns t - t_0 [s], or zero if this is a rounding error or the short time by which a branch begins after its
  /// discontinuity.
  static double passed(const LocalState& own);
  std::string pulley_;
  double length_, damping_;
};

}  // namespace bielle::mechanism
