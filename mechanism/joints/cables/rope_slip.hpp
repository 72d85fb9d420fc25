// Slip of a rope on a pulley with friction: the length s [m] of rope that has slid over the pulley in the direction of
// the rope, from the section before it to the section after it.
//
// Slip follows from a balance of tensions without rates (rope_friction.hpp), relative to the slip s_0 at the end of the
// last accepted step, at the time t_0: it is an algebraic unknown with a memory, like a plastic strain. Its mean rate
// over the present step is (s - s_0)/(t - t_0). The rate at the end of a step, for powers and results, is extrapolated
// from the mean rates of the last two steps, with an error of second order.
#pragma once

#include <cmath>
#include <string>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class RopeSlip final : public Component {
 public:
  /// @param pulley  name of its node   @param length  initial length of the two sections next to it [m]
  /// @param damped  whether the rope has damping, which determines a rate of the slip at the start of a motion
  RopeSlip(std::string type, std::string name, std::string pulley, double length, bool damped);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const override;

  // The following functions take the component's own local state.
  static double slip(const LocalState& own) { return own.first_order()[0]; }
  /// Returns s - s_0 [m].
  static double increment(const LocalState& own) { return slip(own) - own.memory()[slip_memory]; }
  /// Returns the increment of the present step; of the last one at its end [m].
  static double last_increment(const LocalState& own) {
    return may_change(own) ? increment(own) : own.memory()[mean_memory] * own.memory()[step_memory];
  }
  /// Whether slip may change at this state: in a static analysis, and within a step, but not at the beginning of a
  /// motion or of a step.
  static bool may_change(const LocalState& own);
  /// Whether a step has been accepted, so that increments belong to a time.
  static bool has_begun(const LocalState& own) { return !std::isnan(own.memory()[time_memory]); }
  struct Rate {
    double value = 0;    ///< [m/s]
    double by_slip = 0;  ///< derivative by s [1/s]
  };
  /// Returns the mean rate over the present step; over the last one at its end; zero in a static analysis.
  /// Before the first step it is a rate of a very short time, which only serves damping.
  static Rate mean_rate(const LocalState& own);
  /// Returns the rate at this state [m/s]; zero as long as the rope sticks.
  static double rate(const LocalState& own);

 private:
  // Memory: s_0, t_0 (NaN before the first step), mean rate and length of the last step (before the first
  // one: the short time of the rate at the start; 0: none), rate at its end.
  enum : Eigen::Index { slip_memory, time_memory, mean_memory, step_memory, rate_memory, memories };
  /// Returns t - t_0; zero if it is rounding, or the short time by which a branch begins after its discontinuity [s].
  static double passed(const LocalState& own);
  static double rate_at_end(const LocalState& own, double mean, double step);
  std::string pulley_;
  double length_;
  bool damped_;
};

}  // namespace bielle::mechanism
