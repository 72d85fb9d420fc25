// A measure as it was a time T before: y(t) = x(t - T).
//
// At times before the motion x is taken to have been as it was at its beginning. In a static analysis no time passes:
// y = x, and the past begins anew. A delay that is shorter than a step reaches into the step: the value depends on the
// present one, with its exact derivative. A jump of x is spread over the step that follows it.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/control/value_history.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class DelayedMeasure final : public Measure {
 public:
  /// @param time  T [s] > 0 @param points  number of stored values over this time
  DelayedMeasure(std::string name, const Measure& of, double time, int points, std::string units);
  std::string units() const override { return units_; }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;
  bool reads_reactions() const override { return of_.reads_reactions(); }
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  bool knows_memory(const LocalState& state) const override { return history_.knows(state.memory()); }
  void add_break_points(std::vector<double>& times) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  void declare_subjects(Declaration& declaration) const override;
  ValueHistory::Past past(const LocalState& state) const;
  const Measure& of_;
  double time_;
  ValueHistory history_;
  std::string units_;
};

Key delay_key();
const KeyTable& delay_keys();
/// Reads an entry `{delayed: measure, time: T}` of `states`, bound to delay_keys. @throws InputError
void read_delay(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
