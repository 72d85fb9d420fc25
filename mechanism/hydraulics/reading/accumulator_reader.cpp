#include "mechanism/hydraulics/reading/accumulator_reader.hpp"

#include <memory>

#include <fmt/format.h>

#include "mechanism/hydraulics/circuit/accumulator.hpp"
#include "mechanism/hydraulics/lines/line.hpp"
#include "mechanism/hydraulics/reading/line_reader.hpp"

namespace bielle::mechanism {
namespace {

std::vector<Key> gas_keys() {
  using namespace keys;
  return {{"gas_volume", number("m^3").non_negative(), required, "Volume of the gas at the precharge pressure."},
          {"precharge", number("Pa"), required, "Pressure of the gas without fluid."},
          {"exponent", number().between(1, 1.7), otherwise("1.4"),
           "Exponent of the gas: 1 for slow changes (isothermal), 1.4 for quick ones of nitrogen."}};
}

}  // namespace

const KeyTable& own_accumulator_keys() {
  static const KeyTable table{"an accumulator", "A store of gas at the pump or chamber of an actuator.", gas_keys()};
  return table;
}

const KeyTable& accumulator_keys() {
  using namespace keys;
  static const KeyTable table{
      "an accumulator", "A store of gas at a volume.",
      joined({{{"at", name_of("place of the hydraulics"), required, "Volume at which it stores fluid."}}, gas_keys()})};
  return table;
}

void add_accumulator(const std::string& name, const YamlValue& entry, Volume& volume, const Entry& own, Model& model) {
  const double gas_volume = entry.at("gas_volume").number();
  const YamlValue given = entry.at("precharge");
  const double precharge = given.number(), vacuum = volume.fluid().vacuum();
  if (!(precharge > vacuum)) given.fail(fmt::format("expected a pressure above {:.6g} Pa, which is vacuum", vacuum));
  warn_of_pressure(given, precharge, volume.fluid());
  model.add(std::make_unique<Accumulator>(name, volume, gas_volume, precharge, entry.at("exponent").number()), own);
}

void read_accumulator(const std::string& name, const YamlValue& entry, const Entry& own, Model& model) {
  const YamlValue at = entry.at("at");
  const PressureNode& place = place_named_by(at, model);
  Volume* volume = volume_of(place, model);
  if (!volume) at.fail(fmt::format("'{}' is no volume: an accumulator needs one to store in", place.name()));
  add_accumulator(name, entry, *volume, own, model);
}

}  // namespace bielle::mechanism
