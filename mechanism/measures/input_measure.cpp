#include "mechanism/measures/input_measure.hpp"

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void InputMeasure::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("input, starts at {:.6g} [{}]", start_, units_));
}

void read_input(const std::string& name, const YamlValue& entry, Model& model) {
  check_measure_name(name, entry, model);
  double start = 0;
  std::string units = "-";
  if (entry.is_map()) {
    entry.check_keys({"start", "units"}, "an input");
    if (const auto value = entry.find("start")) start = value->number();
    if (const auto word = entry.find("units")) units = word->text();
  } else {
    start = entry.number();
  }
  model.announce_measure(name,
                         [=, &model] { model.add_measure(std::make_unique<InputMeasure>(name, start, units), true); });
}

}  // namespace bielle::mechanism
