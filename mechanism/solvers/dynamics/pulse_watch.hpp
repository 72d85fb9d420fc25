// Formulas of time between the ends of a step: pulses that begin and end there are not felt.
//
// A formula that has moved by more than the ends of a step tell (formula_look.hpp) is told at the end of a run of fixed
// steps. Adaptive steps are judged by the error that this leaves, relative to the tolerance (error_norm.hpp):
//     in a residual    the impulse int r dt - h (r_n + r_{n+1})/2 of the component, as an error of positions or of
//                      first-order unknowns
//     rates            |T - Q| as an error of a position
//     positions        |f - H|
// An impulse on algebraic unknowns alone (pressures of junctions, given pressures) is no error of its own, and what
// they lead to is not known: there steps have to follow the formula itself, some seven in a period.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/solvers/dynamics/error_norm.hpp"
#include "mechanism/solvers/dynamics/formula_look.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class PulseWatch {
 public:
  /// @param begin,span  of the motion [s]: pulses of less than some 1/20000 of it may go unseen
  /// @param length      of the model, as the error norm has it [m]
  PulseWatch(const System& system, double begin, double span, double length);
  bool idle() const { return sources_.empty(); }

  /// Looks at all formulas over a step, with the state at its end.
  void look(const State& end, const Environment& environment, double begin_time, double end_time);
  /// The error that the last look has found, relative to the tolerance.
  double error(const Environment& environment, const ErrorNorm& norm, double tolerance);
  /// Adds the last look to what the run has missed. @param end_time  of that step [s]
  void add(double end_time);
  /// The doubts hold one sentence for each formula that steps have missed much of, for the user at the end of a run.
  std::vector<std::string> doubts() const;

 private:
  struct Source {
    const TimeDependent* component;
    std::size_t member;  ///< of the model; none of a node
    const Slots* slots;
    std::vector<TimeDependent::Formula> formulas;
    std::size_t first;          ///< of its formulas among all
    bool forces = false;        ///< any of them in its residual
    double gain = -1;           ///< error of its impulse over what its formulas have missed [-/s]; negative: not known
    bool on_algebraic = false;  ///< its impulses act on algebraic unknowns alone
  };
  /// The run's looks at a formula, summed up.
  struct Total {
    std::string name;
    double low = 0, high = 0, largest = 0;  ///< range of its change, and of |f| [units]
    double missed = 0, whole = 0;           ///< [units s]; of a position the largest |f - H| [units]
    double most = 0, most_at = 0;           ///< missed in one step, and its end [s]
    double off = 0;                         ///< farthest in one step [units]
  };
  template <class Act>
  void for_each_formula(const Act& act) const;
  void add_source(std::unique_ptr<TimeDependent> own, const TimeDependent& component, const std::string& name,
                  std::size_t member, const Slots& slots);
  /// A formula's changes are judged relative to this.
  static double range(const Total& total);
  double of_motions(const ErrorNorm& norm, double tolerance) const;
  double of_forces(const Environment& environment, const ErrorNorm& norm, double tolerance);
  double estimate(const Source& source) const;
  bool wants_impulse(const Source& source, double large) const;
  void set_impulse(const Source& source, const Environment& environment);
  double missed_by(const Source& source) const;
  bool acts_on_algebraic() const;

  const System& system_;
  double span_, length_;
  std::vector<std::unique_ptr<TimeDependent>> nodes_;
  std::vector<Source> sources_;
  std::vector<Total> totals_;
  // The last look.
  LookedStep step_;
  State state_;  ///< at its end, but for its time
  std::vector<FormulaLook> looks_;
  FormulaLooker looker_;
  std::size_t count_ = 0;
  VectorX impulse_, sum_, part_;  ///< buffers
};

}  // namespace bielle::mechanism
