// Time stepping over an interval: fixed or adaptive steps that end on kinks, with smaller steps if Newton's method
// fails.
//
// Fixed steps keep to their grid; smaller steps between two of its times are only taken if there is a kink or if
// Newton's method failed. Adaptive steps keep the local error of each step (error_norm.hpp) below a tolerance: the next
// size is h * 0.9 (tolerance/error)^(1/3), at most doubled, and it is not changed if the change would be small, because
// a change costs a factorisation.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/solvers/dynamics/error_norm.hpp"
#include "mechanism/solvers/dynamics/event_locator.hpp"
#include "mechanism/solvers/dynamics/march_log.hpp"
#include "mechanism/solvers/dynamics/pulse_watch.hpp"
#include "mechanism/solvers/dynamics/step_stops.hpp"

namespace bielle::mechanism {

/// An event that a step has ended on, or an event within it that changes nothing.
struct Passed {
  double time = 0;         ///< time [s]
  int event_function = 0;  ///< index in System::event_functions
};

/// An accepted step.
struct MarchStep {
  StepReport report;
  double error = 0;            ///< local error over tolerance; 0 with fixed steps
  bool on_grid = true;         ///< ends on a time of the fixed grid; adaptive steps: true, except at events
  std::vector<Passed> passed;  ///< events within it and at its end, in the order of time
};

/// An attempted step, as passed to logs.
struct Attempt {
  enum class Outcome { accepted, refused_by_error, refused_by_newton } outcome;
  double time;  ///< end of the step [s]
  const StepReport& report;
  double error;  ///< error, as in MarchStep
};

class March {
 public:
  /// @param begin  origin of the grid of fixed steps: the integration's time, or earlier if a motion is continued [s]
  /// @param end    end time [s]
  March(TimeIntegration& integration, double begin, double end, StepOptions options);

  bool done() const;
  bool stopped() const { return stopped_; }  ///< whether an event stopped it
  /// Tells that forces have been changed from outside: the next step begins another branch.
  void begin_branch() { pending_ = pending_ == Pending::start ? pending_ : Pending::branch; }
  /// Takes one step. A discontinuity due to a kink at its end is treated when the next step begins; if an event stops
  /// the run there, nothing else is done, and the step has no size.
  /// @throws ComputationError if Newton's method also fails with the smallest steps: 1/1024 of the fixed size, or 1e-10
  ///         of the interval
  MarchStep advance();
  /// Does what events at the end of the march still have to do: actions, and the impulses that follow. Nothing happens
  /// while steps are left, which begin with it. @param step  receives events that follow at the same time
  void settle(MarchStep& step);
  /// Warnings about formulas of time that change between steps, in this program's run. Adaptive steps give no warnings:
  /// such steps are rejected.
  std::vector<std::string> warnings() const { return adaptive() ? std::vector<std::string>() : pulses_.warnings(); }
  /// The log is that of this program's run: it contains no steps before a restart.
  const MarchLog& log() const { return log_; }
  void count_as_before() {  ///< moves the log so far to before_
    before_ = before_.followed_by(log_);
    log_ = {};
  }
  void observe(std::function<void(const Attempt&)> observer) { observer_ = std::move(observer); }
  /// Sets a function that is called when the motion has been restarted after a discontinuity, at the beginning of the
  /// next step.
  void on_jump(std::function<void(const Jump&)> listener) { jump_listener_ = std::move(listener); }
  void exchange(Archive& archive);  ///< for a march with the same options; the integration has its own

 private:
  enum class Pending { nothing, start, restart, branch };
  /// The next step to attempt.
  struct Plan {
    double begin = 0, size = 0, end = 0;  ///< [s]
    bool last = false;                    ///< it is the last before a stop
    bool kink = false;                    ///< it ends on a kink
  };
  /// The result of an attempted step.
  struct Trial {
    StepReport report;
    double error = 0;          ///< local error over tolerance
    bool error_known = false;  ///< also that of first-order unknowns
    double to_event = 0;       ///< size of the step that ends just after its first event [s]; 0: none
  };
  bool adaptive() const { return options_.tolerance > 0; }
  Plan plan() const;
  bool try_step(const Plan& plan, int& too_large, Trial& trial);
  void tell(Attempt::Outcome outcome, const Plan& plan, const Trial& trial) const;
  void count(const Plan& plan, const Trial& trial);
  void pass_noted(double begin, MarchStep& step);
  void heed_echoes();
  void begin_step(MarchStep& step);
  void begin_branches(double h, MarchStep& step);
  bool has_actions_to_do() const;
  void begin_branch(double h, std::optional<Jump>& before);
  void pass_jumps(double h, std::vector<int> jumped, std::optional<Jump>& jump, MarchStep& step);
  void note(const std::vector<int>& passed, MarchStep& step);
  double missed(const Plan& plan);
  double locate(double time, StepReport& report);
  bool is_short(double h) const;
  void change_step(double h);
  StepReport attempt(double h, double end, bool kink);
  [[noreturn]] void throw_chattering(int event_function) const;
  void pass_events(MarchStep& step);
  void refuse_by_error(double h, double error);
  void refuse_by_newton(double h, const StepReport& report);

  TimeIntegration& integration_;
  double end_;
  StepOptions options_;
  StepStops stops_;
  ErrorNorm norm_;
  Pending pending_ = Pending::start;
  EventLocator watch_;
  PulseWatch pulses_;
  std::vector<int> crossed_;  ///< events at the start of the next step
  bool stopped_ = false;
  bool begun_anew_ = false;   ///< the present step has its own start values
  double last_event_ = 0;     ///< time of the last event [s]
  double last_interval_ = 0;  ///< between the last two events [s]
  long events_at_once_ = 0;   ///< consecutive events without progress
  long events_faster_ = 0;    ///< consecutive events with ever shorter intervals
  std::function<void(const Jump&)> jump_listener_;
  double size_ = 0, smallest_ = 0;
  MarchLog log_, before_;  ///< before_: log of the runs that this one continues
  std::function<void(const Attempt&)> observer_;
};

}  // namespace bielle::mechanism
