#include "mechanism/measures/event_record.hpp"

#include <cmath>

#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
namespace {

class RecordMeasure final : public Measure {
 public:
  enum class Quantity { happened, time, count };
  RecordMeasure(std::string name, const EventRecord& record, Quantity quantity)
      : Measure(std::move(name)), record_(record), quantity_(quantity) {}
  std::string units() const override { return quantity_ == Quantity::time ? "s" : "-"; }
  double value(const LocalState& state) const override {
    const LocalState of_record = state.of(0);
    if (quantity_ == Quantity::time) return EventRecord::time(of_record);
    const double count = EventRecord::count(of_record);
    return quantity_ == Quantity::count ? count : count > 0 ? 1 : 0;
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    return value(state);
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&record_}; }
  const EventRecord& record_;
  Quantity quantity_;
};

}  // namespace

void EventRecord::declare(Declaration& declaration) const {
  declaration.passive = true;
  if (used_) declaration.memory = {0, not_yet};
}

bool EventRecord::knows_memory(const LocalState& state) const {
  return !used_ || (count(state) >= 0 && count(state) == std::floor(count(state)));
}

std::unique_ptr<Measure> EventRecord::make_measure(const std::string& name, const std::string& measure) const {
  using Quantity = RecordMeasure::Quantity;
  return std::make_unique<RecordMeasure>(name, *this,
                                         measure == "time"    ? Quantity::time
                                         : measure == "count" ? Quantity::count
                                                              : Quantity::happened);
}

EventRecord* find_event_record(const Model& model, const std::string& name) {
  for (Component* component : model.components_of({Section::events, name}))
    if (auto* record = dynamic_cast<EventRecord*>(component)) return record;
  return nullptr;
}

EventRecord& event_record_named_by(const YamlValue& value, const Model& model) {
  component_named_by(Section::events, value, model);  // refuses names of other things
  EventRecord& record = *find_event_record(model, value.text());
  record.use();
  return record;
}

}  // namespace bielle::mechanism
