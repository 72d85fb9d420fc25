#include "mechanism/hydraulics/reading/circuit_reader.hpp"

#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "mechanism/hydraulics/actuators/machine.hpp"
#include "mechanism/hydraulics/circuit/accumulator.hpp"
#include "mechanism/hydraulics/circuit/places.hpp"
#include "mechanism/hydraulics/circuit/volume.hpp"
#include "mechanism/hydraulics/lines/orifice.hpp"
#include "mechanism/hydraulics/reading/accumulator_reader.hpp"
#include "mechanism/hydraulics/reading/line_reader.hpp"
#include "mechanism/joints/couplings/coordinate_named_by.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_activity.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& circuit_fluid_keys() {
  static const KeyTable table{"a fluid", "The fluid of the circuit.", fluid_keys()};
  return table;
}

const KeyTable& volume_keys() {
  using namespace keys;
  static const KeyTable table{
      "a volume",
      "A place that stores fluid.",
      {{"volume", number("m^3").non_negative(), otherwise("0"),
        "Volume of fluid besides that of chambers; 0 if chambers alone make it."},
       {"pressure", number("Pa"), computed("in equilibrium with the load, or the ambient pressure"),
        "Pressure at the start. By default it is in equilibrium with the load if all places of an actuator's `ports` "
        "leave it open."},
       {"compliance", number("m^3/Pa").non_negative(), otherwise("0"),
        "Compliance of the walls: growth of the volume per pressure."}}};
  return table;
}

const KeyTable& supply_keys() {
  using namespace keys;
  static const KeyTable table{
      "a supply",
      "A place of given pressure, or a pump of given flow.",
      {{"pressure", state_formula("Pa", {"t"}), optional, "Pressure of the place for any flow."},
       {"flow", state_formula("m^3/s", {"t"}), optional, "Flow of a pump into `to`."},
       {"to", name_of("place of the hydraulics"), computed("a place of the supply's own name if it has a `pressure`"),
        "Place that has the pressure, or into which the pump delivers."},
       {"from", name_of("place of the hydraulics"), computed("from outside"), "Place from which the pump draws."}}};
  return table;
}

const KeyTable& machine_keys() {
  using namespace keys;
  static const KeyTable table{
      "a machine",
      "A pump or motor on a coordinate of a joint, its shaft.",
      {{"joint", coordinate_forms(), required, "Joint, or `joint.coordinate`, of the shaft."},
       {"from", name_of("place of the hydraulics"), required, "Place from which positive turning moves the fluid."},
       {"to", name_of("place of the hydraulics"), required, "Place to which positive turning moves the fluid."},
       {"displacement", number("m^3/rad or m^2").non_negative(), required, "Volume per angle or displacement."},
       {"setting", state_formula("", {"t"}), otherwise("1"), "Factor of the displacement."},
       {"leakage", number("m^3/(s Pa)").non_negative(), otherwise("0"), "Leakage flow per pressure difference."},
       {"drag", number("N m s/rad or N s/m").non_negative(), otherwise("0"), "Moment or force per rate."}}};
  return table;
}

class CircuitReader {
 public:
  CircuitReader(const YamlValue& section, Model& model) : section_(section.keyed(hydraulics_keys())), model_(model) {
    read_ambient_pressure(section_, fluid_);
    if (const auto fluid = section_.find("fluid")) read_fluid(*fluid, fluid_);
  }

  void read() {
    note_given_pressures();
    note_ends_of_pipes();
    each("volumes", [&](const std::string& name, const YamlValue& entry) { read_volume(name, entry); });
    if (const auto junctions = section_.find("junctions"))
      for (const YamlValue& item : junctions->items()) read_junction(item);
    // Pumps may draw from places that are created by pressure supplies.
    each("supplies", [&](const std::string& name, const YamlValue& entry) {
      if (!entry.has("flow")) read_supply(name, entry);
    });
    if (const auto supplies = section_.find("supplies"))
      for (const auto& [name, entry] : supplies->entries())
        if (entry.has("flow")) read_supply(name, entry);
    each("lines", [&](const std::string& name, const YamlValue& entry) {
      read_line(name, entry, fluid_, model_);
      read_activity(entry, own(name), model_);
    });
    each("accumulators", [&](const std::string& name, const YamlValue& entry) {
      read_accumulator(name, entry, {Section::hydraulics, name}, model_);
    });
    each("machines", [&](const std::string& name, const YamlValue& entry) { read_machine(name, entry); });
  }

 private:
  Entry own(const std::string& name) const { return {Section::hydraulics, name}; }

  /// Reads each entry of a section. Names are those of results: each may only occur once in all of the hydraulics.
  template <class Read>
  void each(const char* key, const Read& read) {
    const auto entries = section_.find(key);
    if (!entries) return;
    for (const auto& [name, entry] : entries->entries()) {
      check_name(name, entry);
      take(name, entry);
      read(name, entry);
    }
  }
  void take(const std::string& name, const YamlValue& place) {
    const auto [found, is_new] = taken_.try_emplace(name, place.path());
    if (!is_new)
      place.fail(fmt::format("'{}' is the name of another entry of the hydraulics: {}", name, found->second));
  }

  /// Records pressure supplies: their places have a given pressure, for any flow.
  void note_given_pressures() {
    if (const auto supplies = section_.find("supplies"))
      for (const auto& [name, entry] : supplies->entries())
        if (entry.has("pressure") && entry.has("to")) given_.emplace(entry.at("to").text(), name);
  }

  /// Records the junctions at the ends of pipes. They contain the last part of the pipes' fluid, because a junction
  /// without volume could not stop its inertia.
  void note_ends_of_pipes() {
    const auto lines = section_.find("lines");
    if (!lines) return;
    for (const auto& [name, entry] : lines->entries()) {
      const auto pipe = entry.find("pipe");
      if (!pipe || !pipe->is_map() || !pipe->has("pressure")) continue;
      for (const char* end : {"from", "to"})
        if (const auto place = entry.find(end)) {
          const double p = pipe->at("pressure").number();
          const auto [first, is_new] = ends_of_pipes_.try_emplace(place->text(), EndOfPipes{name, p, {}, p});
          if (!is_new && p != first->second.pressure) first->second.other = name, first->second.other_pressure = p;
        }
    }
  }

  void read_volume(const std::string& name, const YamlValue& entry) {
    const auto pressure = entry.find("pressure");
    const double V = entry.at("volume").number(), c = entry.at("compliance").number();
    const double p = pressure ? pressure->number() : fluid_.ambient;
    if (pressure) check_pressure(*pressure, p);
    if (const auto given = given_.find(name); given != given_.end()) {
      entry.warn(fmt::format("the supply '{}' keeps the pressure of this place: its volume and start do not matter",
                             given->second));
      return;  // created by the supply
    }
    auto place = std::make_unique<Volume>(name, fluid_, V, p, c);
    model_.when_read(Model::Stage::connections, [place = place.get(), entry] {
      if (!(place->drawn() > 0))
        entry.fail(
            "has no space as drawn, neither a `volume` [m^3] nor one of a chamber: give one, or list it under "
            "`junctions`");
    });
    if (!pressure) place->let_load_decide();
    model_.add(std::move(place), own(name));
  }

  void check_pressure(const YamlValue& place, double p) const {
    const double least = fluid_.vacuum();
    if (!(p > least)) place.fail(fmt::format("expected a pressure above {:.6g} Pa, which is vacuum", least));
    warn_of_pressure(place, p, fluid_);
  }

  void read_junction(const YamlValue& item) {
    const std::string name = item.text();
    check_name(name, item);
    take(name, item);
    if (const auto found = ends_of_pipes_.find(name); found != ends_of_pipes_.end()) {
      const EndOfPipes& end = found->second;
      if (!end.other.empty())
        item.warn(
            fmt::format("the pipe '{}' that leads here begins with {:.6g} Pa, '{}' with {:.6g} Pa: the junction "
                        "begins with the first of them",
                        end.pipe, end.pressure, end.other, end.other_pressure));
      model_.add(std::make_unique<Volume>(name, fluid_, 0, end.pressure, 0, pipe_junction), own(name));
    } else
      model_.add(std::make_unique<Junction>(name, fluid_, fluid_.ambient), own(name));
  }

  void read_supply(const std::string& name, const YamlValue& entry) {
    const auto pressure = entry.find("pressure"), flow = entry.find("flow"), from = entry.find("from");
    if (pressure.has_value() == flow.has_value()) entry.fail("give `pressure` [Pa] or `flow` [m^3/s]: one of the two");
    if (flow) {
      auto source = std::make_unique<FlowSource>(name, from ? &place_named_by(*from, model_) : nullptr,
                                                 place_named_by(entry.at("to"), model_));
      model_.when_read(Model::Stage::formulas, [source = source.get(), formula = *flow, this_model = &model_] {
        source->read(formula, *this_model);
      });
      model_.add(std::move(source), own(name));
      return;
    }
    if (from) from->fail("belongs to a supply of flow");
    std::string place = name;
    if (const auto to = entry.find("to")) {
      place = to->text();
      check_name(place, *to);
      if (place != name) take(place, *to);
      if (const auto other = supplied_.find(place); other != supplied_.end())
        to->fail(fmt::format("the supply '{}' gives it a pressure already", other->second));
      supplied_.emplace(place, name);
      if (!model_.components_of(own(place)).empty())
        to->fail(fmt::format(
            "'{}' exists and is no volume: a supply of pressure makes its place, or takes one of the volumes", place));
    }
    auto source = std::make_unique<PressureSource>(place, fluid_);
    model_.when_read(Model::Stage::formulas, [source = source.get(), formula = *pressure, this_model = &model_] {
      source->read(formula, *this_model);
    });
    model_.add(std::move(source), own(place));
  }

  void read_machine(const std::string& name, const YamlValue& entry) {
    Machine::Data data{entry.at("displacement").number()};
    data.leakage = entry.at("leakage").number();
    data.drag = entry.at("drag").number();
    const YamlValue to = entry.at("to");
    const PressureNode &a = place_named_by(entry.at("from"), model_), &b = place_named_by(to, model_);
    if (&a == &b) to.fail("a machine moves fluid from one place to another");
    model_.when_read(Model::Stage::connections, [name, entry, data, &a, &b, model = &model_] {
      const NamedCoordinate shaft = coordinate_named_by(entry.at("joint"), *model);
      auto machine = std::make_unique<Machine>(name, *shaft.joint, shaft.index, a, b, data);
      model->when_read(Model::Stage::formulas, [machine = machine.get(), setting = entry.at("setting"), model] {
        machine->read_setting(setting, *model);
      });
      model->add(std::move(machine), {Section::hydraulics, name});
    });
  }

  YamlValue section_;
  Model& model_;
  Fluid fluid_;
  std::map<std::string, std::string> taken_;     ///< path of the entry that uses each name
  std::map<std::string, std::string> given_;     ///< places of given pressure, with their supplies
  std::map<std::string, std::string> supplied_;  ///< those that have been created
  /// A place at the end of one or more pipes.
  struct EndOfPipes {
    std::string pipe;   ///< name of the first pipe
    double pressure;    ///< start pressure of its fluid [Pa]
    std::string other;  ///< a pipe with another pressure; empty: there is none
    double other_pressure;
  };
  std::map<std::string, EndOfPipes> ends_of_pipes_;  ///< by name
};

}  // namespace

std::vector<std::string> circuit_types() {
  std::vector<std::string> types = line_types();
  for (const char* type : {"volume", "supply", "accumulator", "machine"}) types.emplace_back(type);
  return types;
}

const KeyTable& hydraulics_keys() {
  using namespace keys;
  static const KeyTable table{
      "the hydraulics",
      "Circuits that hydraulic actuators share; all entries have different names.",
      {ambient_pressure_key(),
       {"fluid", nested(circuit_fluid_keys), optional, "The fluid; hydraulic oil without the key."},
       {"volumes", entries("hydraulics", {nested(volume_keys)}), optional, "Places that store fluid."},
       {"junctions", list_of(name_of("place of the hydraulics")), optional,
        "Places at which lines meet and nothing is stored."},
       {"supplies", entries("hydraulics", {nested(supply_keys)}), optional,
        "Places of given pressure, such as tanks, and pumps of given flow."},
       {"lines", entries("hydraulics", {nested(line_keys)}), optional, "Connections of places."},
       {"accumulators", entries("hydraulics", {nested(accumulator_keys)}), optional, "Stores of gas at volumes."},
       {"machines", entries("hydraulics", {nested(machine_keys)}), optional, "Pumps and motors on joints."}}};
  return table;
}

void read_hydraulics(const YamlValue& section, Model& model) { CircuitReader(section, model).read(); }

}  // namespace bielle::mechanism
