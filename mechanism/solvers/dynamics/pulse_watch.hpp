// Formulas of time between the ends of a step: pulses that begin and end there are not felt.
//
// The scheme sees a formula f(t) at the ends of its steps. Over a step of size h it takes the integral for
//     T = h (f_n + f_{n+1})/2     in place of     Q = int f dt,
// Q by the midpoints of parts of the step. For a formula that steps resolve, |T - Q| is (omega h)^2/12 of int |f| dt;
// for a pulse within the step it is all of int |f| dt.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/time_dependent.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class PulseWatch {
 public:
  /// @param span  of the motion [s]: pulses of less than some 1/20000 of it may go unseen
  PulseWatch(const System& system, double span);
  bool idle() const { return sources_.empty(); }

  /// A look is at one formula in one step.
  struct Look {
    std::size_t formula = 0;  ///< by number
    double missed = 0;        ///< |T - Q| [units s]
    double whole = 0;         ///< int |f| dt [units s]
    double farthest = 0;      ///< where f is farthest from the chord between the ends [s]
    double distance = 0;      ///< from it there [units]
  };
  /// Looks at all formulas over a step, with the state at its end.
  /// @returns the look at that of which the largest part is missed; missed = 0 where none holds the time
  Look look(const State& end, const Environment& environment, double begin_time, double end_time);
  /// Adds the last look to what the run has missed. @param end_time  of that step [s]
  void add(double end_time);
  /// The doubts hold one sentence for each formula that steps have missed much of, for the user at the end of a run.
  std::vector<std::string> doubts() const;

 private:
  struct Source {
    std::size_t member;
    const TimeDependent* component;
    std::size_t first, count;  ///< of its formulas
  };
  struct Total {
    std::string name, units;
    double missed = 0, whole = 0;  ///< over the run [units s]
    double most = 0, most_at = 0;  ///< in one step, and its end [s]
  };
  void look(const Source& source, const LocalState& state, double begin_time, double end_time, int parts);

  const System& system_;
  double span_;
  std::vector<Source> sources_;
  std::vector<Total> totals_;
  std::vector<Look> looks_;
  std::vector<double> begin_, end_, sum_, value_;  ///< buffers of `look`
};

}  // namespace bielle::mechanism
