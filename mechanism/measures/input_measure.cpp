#include "mechanism/measures/input_measure.hpp"

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void InputMeasure::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("input, starts at {:.6g} [{}]", start_, units_));
}

const KeyTable& input_keys() {
  using namespace keys;
  static const KeyTable table{"an input",
                              "A number that formulas use by its name, and that a program changes during the motion.",
                              {{"start", number("any"), otherwise("0"), "Value at the start."},
                               {"units", text(), otherwise("'-'"), "Units that are recorded with the values."}}};
  return table;
}

void read_input(const std::string& name, const YamlValue& given, Model& model) {
  check_measure_name(name, given, model);
  double start = 0;
  std::string units = "-";
  if (given.is_map()) {
    const YamlValue entry = given.keyed(input_keys());
    start = entry.at("start").number();
    units = entry.at("units").text();
  } else {
    start = given.number();
  }
  model.announce_measure(name,
                         [=, &model] { model.add_measure(std::make_unique<InputMeasure>(name, start, units), true); });
}

}  // namespace bielle::mechanism
