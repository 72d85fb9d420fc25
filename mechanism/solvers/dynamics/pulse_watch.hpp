// Formulas of time between the ends of a step: the scheme does not notice pulses that begin and end there.
//
// For fixed steps, a formula that has changed by more than the ends of a step show (formula_look.hpp) is reported at
// the end of a run. Adaptive steps are controlled by the resulting error, relative to the tolerance (error_norm.hpp):
//     in a residual    the impulse int r dt - h (r_n + r_{n+1})/2 of the component, as an error of positions or of
//                      first-order unknowns
//     rates            |T - Q| as an error of a position
//     positions        |f - H|
// An impulse on algebraic unknowns only (pressures of junctions, given pressures) has no error of its own, and its
// consequences are unknown: steps then have to resolve the formula itself, with about seven in a period.
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
  /// @param begin,span  start and duration of the motion [s]: pulses shorter than about 1/20000 of it may be missed
  /// @param length      length of the model, as in the error norm [m]
  PulseWatch(const System& system, double begin, double span, double length);
  bool idle() const { return sources_.empty(); }

  /// Evaluates all formulas over a step, with the state at its end.
  void look(const State& end, const Environment& environment, double begin_time, double end_time);
  /// Returns the error found in the last evaluation, relative to the tolerance.
  double error(const Environment& environment, const ErrorNorm& norm, double tolerance);
  /// Adds the last evaluation to the totals of the run. @param end_time  end of that step [s]
  void add(double end_time);
  /// Returns one warning for each formula of which steps have missed a large part, for the end of a run.
  std::vector<std::string> warnings() const;

 private:
  struct Source {
    const TimeDependent* component;
    std::size_t member;  ///< member of the model; none for a node
    const Slots* slots;
    std::vector<TimeDependent::Formula> formulas;
    std::size_t first;          ///< index of its first formula
    bool forces = false;        ///< whether any of them is in its residual
    double gain = -1;           ///< ratio of impulse error to missed part of its formulas [-/s]; negative: not known
    bool on_algebraic = false;  ///< its impulses act only on algebraic unknowns
  };
  /// Totals of a formula over the run.
  struct Total {
    std::string name;
    double low = 0, high = 0, largest = 0;  ///< range of its change, and of |f| [units]
    double missed = 0, whole = 0;           ///< [units s]; for a position the largest |f - H| [units]
    double most = 0, most_at = 0;           ///< largest part missed in one step, and the end of that step
    double off = 0;                         ///< largest distance in one step [units]
  };
  template <class Act>
  void for_each_formula(const Act& act) const;
  void add_source(std::unique_ptr<TimeDependent> own, const TimeDependent& component, const std::string& name,
                  std::size_t member, const Slots& slots);
  /// Range relative to which a formula's changes are judged.
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
  // The last evaluation.
  LookedStep step_;
  State state_;  ///< state at its end, except its time
  std::vector<FormulaLook> looks_;
  FormulaLooker looker_;
  std::size_t count_ = 0;
  VectorX impulse_, sum_, part_;  ///< buffers
};

}  // namespace bielle::mechanism
