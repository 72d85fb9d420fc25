// The value of a measure at a time T before the present one: y(t) = x(t - T).
//
// At times before the motion x has its value at the beginning of the motion. In a static analysis no time passes: y =
// x, and the history of x begins again. A delay that is shorter than a step depends on the end of the step: the
// derivative of y by the present value of x is exact. A jump of x comes back after T: a step ends there (Echo).
#pragma once

#include <string>
#include <vector>

#include "mechanism/measures/value_history.hpp"
#include "mechanism/model/echo.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

class DelayedMeasure final : public Measure, public Echo {
 public:
  static constexpr int usual_points = 1000;
  /// @param time  T [s] > 0 @param points  number of stored values over this time
  DelayedMeasure(std::string name, const Measure& of, double time, int points, std::string units);
  const Measure& of() const { return of_; }
  double time() const { return history_.span(); }  ///< T [s]
  std::string units() const override { return units_; }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;
  bool reads_reactions() const override { return of_.reads_reactions(); }
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  bool knows_memory(const LocalState& state) const override;
  void add_break_points(std::vector<double>& times) const override;
  void describe(const LocalState& state, Description& description) const override;

  void note_jump(const LocalState& state, double time, Eigen::Ref<VectorX> memory) const override;
  double next_echo(const LocalState& state, double after) const override;
  void forget(Eigen::Ref<VectorX> memory) const override;
  /// Place in the component's memory of a number that is added to the delayed value: 0, except where a response to it
  /// is computed.
  static constexpr int disturbance = 0;

 private:
  void declare_subjects(Declaration& declaration) const override;
  Eigen::Ref<const VectorX> past_of(const LocalState& state) const;
  ValueHistory::Past past(const LocalState& state) const;
  void check_stored(bool stored, double time) const;
  const Measure& of_;
  ValueHistory history_;
  std::string units_;
};

}  // namespace bielle::mechanism
