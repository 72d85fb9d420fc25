// The record of an event, which formulas, other events and locks read by the event's name.
//
//     deployed          0 before the event has happened, 1 afterwards
//     deployed.count    number of times that it has happened
//     deployed.time     time at which it happened last [s]; 1e30 before, in the far future, so that
//                       t >= deployed.time is false and min(max((t - deployed.time)/T, 0), 1) is 0
// The record refers to nothing: events may depend on each other in a circle through their records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/model/component.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class EventRecord final : public Component {
 public:
  explicit EventRecord(std::string name) : Component("event", std::move(name)) {}
  static constexpr double not_yet = 1e30;  ///< time of an event that has not happened [s]
  /// Tells that something depends on the record: the event then ends a step, and is counted.
  void use() { used_ = true; }
  bool is_used() const { return used_; }

  // Values at a state of this component; the record must be in use.
  static double count(const LocalState& state) { return state.memory()[0]; }
  static bool has_happened(const LocalState& state) { return count(state) > 0; }
  static double time(const LocalState& state) { return state.memory()[1]; }
  static void happen(double time, Eigen::Ref<VectorX> memory) {
    memory[0] += 1;
    memory[1] = time;
  }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
  bool knows_memory(const LocalState& state) const override;
  /// The names are "time" and "count"; the name "" makes the measure that is 0 or 1.
  std::vector<std::string> measure_names() const override { return {"time", "count"}; }
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

 private:
  bool used_ = false;
};

/// Returns the record of the event with a name, or nullptr.
EventRecord* find_event_record(const Model& model, const std::string& name);
/// Returns the record of the event that a value names, which is in use from now on. @throws InputError naming the
/// nearest name
EventRecord& event_record_named_by(const YamlValue& value, const Model& model);

}  // namespace bielle::mechanism
