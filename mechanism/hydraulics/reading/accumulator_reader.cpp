#include "mechanism/hydraulics/reading/accumulator_reader.hpp"

#include <memory>

#include <fmt/format.h>

#include "mechanism/hydraulics/circuit/accumulator.hpp"
#include "mechanism/hydraulics/lines/line.hpp"
#include "mechanism/hydraulics/reading/line_reader.hpp"

namespace bielle::mechanism {

void add_accumulator(const std::string& name, const YamlValue& entry, Volume& volume, const Entry& own, Model& model) {
  const double gas_volume = entry.at("gas_volume").non_negative_number();
  const YamlValue given = entry.at("precharge");
  const double precharge = given.number(), vacuum = volume.fluid().vacuum();
  if (!(precharge > vacuum)) given.fail(fmt::format("expected a pressure above {:.6g} Pa, which is vacuum", vacuum));
  warn_of_pressure(given, precharge, volume.fluid());
  double exponent = 1.4;
  if (const auto n = entry.find("exponent")) {
    exponent = n->number();
    if (exponent < 1 || exponent > 1.7) n->fail("expected 1 (isothermal) to 1.67; nitrogen has 1.4 when it is quick");
  }
  model.add(std::make_unique<Accumulator>(name, volume, gas_volume, precharge, exponent), own);
}

void read_accumulator(const std::string& name, const YamlValue& entry, const Entry& own, Model& model) {
  entry.check_keys({"at", "gas_volume", "precharge", "exponent"}, "an accumulator");
  const YamlValue at = entry.at("at");
  const PressureNode& place = place_named_by(at, model);
  Volume* volume = volume_of(place, model);
  if (!volume) at.fail(fmt::format("'{}' is no volume: an accumulator needs one to store in", place.name()));
  add_accumulator(name, entry, *volume, own, model);
}

}  // namespace bielle::mechanism
