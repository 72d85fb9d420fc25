// Steps through a span of time: fixed or adaptive steps, ends on kinks, smaller steps where Newton's method fails.
//
// Fixed steps keep to their grid; between two of its times smaller steps are taken only where a kink lies there or
// where Newton's method failed. Adaptive steps keep the local error of each step (error_norm.hpp) below a tolerance:
// the next size is h * 0.9 (tolerance/error)^(1/3), at most doubled, and stays where it would change by little, because
// a change costs a factorisation.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/solvers/dynamics/crossing_watch.hpp"
#include "mechanism/solvers/dynamics/error_norm.hpp"
#include "mechanism/solvers/dynamics/pulse_watch.hpp"

namespace bielle::mechanism {

struct StepOptions {
  double size = 0;                                           ///< [s] fixed, or tried first
  double tolerance = 0;                                      ///< of the local error; 0: fixed steps
  double largest = std::numeric_limits<double>::infinity();  ///< [s] adaptive steps only
  /// Times at which forces or prescribed motions have kinks. Those outside the span do not matter.
  std::vector<double> break_points;
};

/// A crossing that a step has ended on, or one within it that changes nothing.
struct Passed {
  double time = 0;   ///< [s]
  int crossing = 0;  ///< by number, System::crossings
};

/// An accepted step.
struct MarchStep {
  StepReport report;
  double error = 0;            ///< local error over tolerance; 0 with fixed steps
  bool on_grid = true;         ///< ends on a time of the fixed grid; always true with adaptive steps, but for crossings
  std::vector<Passed> passed;  ///< the crossings within it and at its end, by their times
};

/// A step that was tried, as told to those who keep a log.
struct Attempt {
  enum class Outcome { accepted, refused_by_error, refused_by_newton } outcome;
  double time;  ///< at its end [s]
  const StepReport& report;
  double error;  ///< as in MarchStep
};

/// What a march did.
struct MarchLog {
  long steps = 0, iterations = 0;    ///< accepted steps; linear solves, those of refused steps included
  long factorisations = 0;           ///< of the tangent
  long shortened = 0;                ///< iterations whose full step was too long
  long refused_by_error = 0;         ///< steps whose local error was too large
  long refused_by_newton = 0;        ///< steps in which Newton's method failed
  long crossings = 0;                ///< that were met
  double smallest = 0, largest = 0;  ///< accepted steps [s], those cut short by kinks left out
  int most_iterations = 0;           ///< of an accepted step
  double most_iterations_at = 0;     ///< [s]
  int slowest_equation = -1;         ///< that was the worst at the end of that step; -1: none
  std::string hardest;               ///< why a step was last refused; empty when none was

  void exchange(Archive& archive, int equations);    ///< all but the text
  MarchLog followed_by(const MarchLog& next) const;  ///< the log of both together
};

class March {
 public:
  /// @param begin  where the grid of fixed steps has its origin: the integration's time, or before it when a motion is
  ///               continued [s]
  /// @param end    [s]
  March(TimeIntegration& integration, double begin, double end, StepOptions options);
  ~March();

  bool done() const;
  bool stopped() const { return stopped_; }  ///< by a crossing
  /// Forces have changed from outside: the next step begins another branch.
  void begin_branch() { pending_ = pending_ == Pending::start ? pending_ : Pending::branch; }
  /// Takes one step. What a kink at its end asks for is done when the next one begins; where a crossing stops the run
  /// there, that is all, and the step has no size.
  /// @throws ComputationError when Newton's method fails with the smallest steps too: 1/1024 of the fixed size,
  ///         or 1e-10 of the span
  MarchStep advance();
  /// The doubts are sentences for the user about formulas of time that change between steps, in this program's run. Of
  /// adaptive steps there are none: they are refused.
  std::vector<std::string> doubts() const { return adaptive() ? std::vector<std::string>() : pulses_.doubts(); }
  /// The log is that of this program's run: it contains no steps from before a restart.
  const MarchLog& log() const { return log_; }
  void count_as_before() {  ///< what it has done so far
    before_ = before_.followed_by(log_);
    log_ = {};
  }
  void observe(std::function<void(const Attempt&)> observer) { observer_ = std::move(observer); }
  /// Called where the motion has been started anew after a discontinuity, at the beginning of the next step.
  void on_jump(std::function<void(const Jump&)> listener) { jump_listener_ = std::move(listener); }
  void exchange(Archive& archive);  ///< of a march with the same options; the integration has its own

 private:
  class Stops;
  enum class Pending { nothing, start, restart, branch };
  /// The step to try next.
  struct Plan {
    double begin = 0, size = 0, end = 0;  ///< [s]
    bool last = false;                    ///< before a stop
    bool kink = false;                    ///< ends on one
  };
  /// What became of it.
  struct Trial {
    StepReport report;
    double error = 0;          ///< local error over tolerance
    bool error_known = false;  ///< of first-order unknowns, too
    double crossing = 0;       ///< size of the step that ends just after its first crossing [s]; 0: none
  };
  bool adaptive() const { return options_.tolerance > 0; }
  Plan plan() const;
  bool try_step(const Plan& plan, int& too_large, Trial& trial);
  void tell(Attempt::Outcome outcome, const Plan& plan, const Trial& trial) const;
  void count(const Plan& plan, const Trial& trial);
  void pass_noted(double begin, MarchStep& step);
  void begin_step(MarchStep& step);
  void begin_branch(double h, std::optional<Jump>& before);
  void pass_jumps(double h, std::vector<int> jumped, std::optional<Jump>& jump, MarchStep& step);
  void note(const std::vector<int>& passed, MarchStep& step);
  double missed(const Plan& plan);
  double locate(double time, StepReport& report);
  bool is_short(double h) const;
  void change_step(double h);
  StepReport attempt(double h, double end, bool kink);
  [[noreturn]] void throw_chattering(int crossing) const;
  void pass_crossings(MarchStep& step);
  void refuse_by_error(double h, double error);
  void refuse_by_newton(double h, const StepReport& report);

  TimeIntegration& integration_;
  double end_;
  StepOptions options_;
  std::unique_ptr<Stops> stops_;
  ErrorNorm norm_;
  Pending pending_ = Pending::start;
  CrossingWatch watch_;
  PulseWatch pulses_;
  std::vector<int> crossed_;  ///< past which the next step begins
  bool stopped_ = false;
  bool begun_anew_ = false;     ///< the present step has start values of its own
  double last_crossing_ = 0;    ///< [s]
  long crossings_at_once_ = 0;  ///< that have followed each other without progress
  std::function<void(const Jump&)> jump_listener_;
  double size_ = 0, smallest_ = 0;
  MarchLog log_, before_;  ///< before_: of the runs that this one goes on from
  std::function<void(const Attempt&)> observer_;
};

}  // namespace bielle::mechanism
