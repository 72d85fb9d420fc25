// An event that occurs when a measure crosses a value. The event is located within a step and recorded; it may end the
// step and restart the motion there, as a kink does, or stop the run.
//
//     events: {landed: {when: ball.position.z, crosses: 0.1, direction: falling, action: stop}}
#pragma once

#include <string>

#include "mechanism/model/measure.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class MeasureEvent final : public Component {
 public:
  enum class Action { note, restart, stop };
  MeasureEvent(std::string name, const Measure& measure, double value, EventFunction::Direction direction,
               Action action);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  const Measure& measure() const { return measure_; }
  double value() const { return value_; }
  EventFunction::Direction direction() const { return direction_; }

 private:
  References references_;
  const Measure& measure_;
  double value_;
  EventFunction::Direction direction_;
  Action action_;
};

/// Returns the key `direction` of an entry with `crosses`.
Key crossing_direction_key();
/// Reads the key `direction` of an entry; the default is both.
EventFunction::Direction read_crossing_direction(const YamlValue& entry);

const KeyTable& event_keys();
/// Reads an entry of `events`, after the model has been read: `{when: measure or formula, crosses: value, direction:
/// rising | falling | both, action: note | restart | stop}`. @throws InputError
void read_event(const std::string& name, const YamlValue& given, Model& model);

}  // namespace bielle::mechanism
