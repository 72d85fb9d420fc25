#include "mechanism/elements/control/delay_reader.hpp"

#include <memory>

#include <fmt/format.h>

#include "mechanism/measures/delayed_measure.hpp"
#include "mechanism/measures/read_measure.hpp"

namespace bielle::mechanism {

Key delay_key() {
  using namespace keys;
  return {"delayed", state_formula("any", {"t"}), required, "Measure that is delayed, or a formula of measures."};
}

const KeyTable& delay_keys() {
  using namespace keys;
  static const KeyTable table{
      "a delay",
      "A measure as it was a time before; at first, as it was at the beginning of the motion.",
      {delay_key(),
       {"time", number("s").positive(), required, "Time by which the measure is delayed."},
       {"points", integer().between(4, 1e6), otherwise(fmt::format("{}", DelayedMeasure::usual_points)),
        "Largest number of values that are stored over this time, at the ends of steps; a third as many jumps have "
        "places as well."},
       {"units", text(), computed("those of the measure"), "Units that are recorded with the values."}}};
  return table;
}

void read_delay(const std::string& name, const YamlValue& entry, Model& model) {
  const double time = entry.at("time").number();
  const int points = entry.at("points").integer();
  model.announce_measure(name, [name, entry, time, points, &model] {
    const Measure& of = measure_named_by(entry.at("delayed"), model);
    const auto units = entry.find("units");
    model.add_measure_of(Entry{Section::states, name},
                         std::make_unique<DelayedMeasure>(name, of, time, points, units ? units->text() : of.units()),
                         true);
  });
}

}  // namespace bielle::mechanism
