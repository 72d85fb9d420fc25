// An event that occurs when a measure crosses a value. The event is located within a step and recorded; it may end the
// step and restart the motion there, as a kink does, stop the run, or change other parts of the mechanism.
//
//     events: {landed: {when: ball.position.z, crosses: 0.1, direction: falling, do: [{lock: knee}, {stop: true}]}}
//
// An action writes to the memory of a component: the value of an input, the command of a lock, the activity of an
// entry. All actions at one instant are done in the order of the file, then the motion begins another branch with
// impulses where constraints have closed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/measures/event_record.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/event_actions.hpp"
#include "mechanism/model/lockable.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class MeasureEvent final : public Component, public EventActions {
 public:
  enum class Action { note, restart, stop };
  /// An action: the entry of another component's memory is set to a value.
  struct Write {
    int reference = 0;        ///< number of the component among those referred to
    int place = 0;            ///< index in its memory
    StateFormula value;       ///< formula of t and measures
    const Lockable* locks{};  ///< the component, if its present value is written in place of the formula's
    bool switches = false;    ///< it switches constraints or forces on or off
    std::string description;  ///< "releases 'sling'"; empty: another write says it
  };
  /// @param record  memory of the event; it is used if anything depends on it
  MeasureEvent(const EventRecord& record, const Measure& measure, double value, EventFunction::Direction direction,
               Action action);
  /// Lets the event occur only once. @pre the record is in use
  void occur_once() { once_ = true; }
  /// Lets the event occur at the start of a motion if the value is reached or exceeded there. @pre one direction
  void occur_at_start() { at_start_ = true; }
  /// Lets the event occur only after another one has occurred.
  void occur_after(const EventRecord& other);
  References& references() { return references_; }
  /// Adds an action after those before. @pre the record is in use
  void add(Write write) { writes_.push_back(std::move(write)); }
  void stop() { action_ = Action::stop; }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void act(const LocalState& state, std::span<const int> crossed, const ReferencedMemory& memory) const override;
  bool has_actions() const override { return record_.is_used(); }
  bool switches_parts() const override;
  void describe(const LocalState& state, Description& description) const override;
  const Measure& measure() const { return measure_; }
  double value() const { return value_; }
  EventFunction::Direction direction() const { return direction_; }

 private:
  bool is_armed(const LocalState& state) const;
  int side_before() const { return direction_ == EventFunction::Direction::rising ? -1 : 1; }
  std::string effects() const;

  References references_;
  const EventRecord& record_;
  const Measure& measure_;
  double value_;
  EventFunction::Direction direction_;
  Action action_;
  bool once_ = false, at_start_ = false;
  const EventRecord* after_ = nullptr;
  int of_record_, of_after_ = -1;  ///< numbers among the references
  std::vector<Write> writes_;
};

/// Returns the event that a value names; events are there when formulas have been read. @throws InputError naming the
/// nearest name
const MeasureEvent& measure_event_named_by(const YamlValue& value, const Model& model);

/// Returns the key `direction` of an entry with `crosses`.
Key crossing_direction_key();
/// Reads the key `direction` of an entry; the default is both.
EventFunction::Direction read_crossing_direction(const YamlValue& entry);

}  // namespace bielle::mechanism
