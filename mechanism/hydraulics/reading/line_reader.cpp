#include "mechanism/hydraulics/reading/line_reader.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/hydraulics/circuit/volume.hpp"
#include "mechanism/hydraulics/lines/orifice.hpp"
#include "mechanism/hydraulics/lines/pipe_segment.hpp"
#include "mechanism/hydraulics/lines/pressure_valve.hpp"
#include "mechanism/hydraulics/lines/spool_valve.hpp"
#include "mechanism/hydraulics/reading/line_keys.hpp"

namespace bielle::mechanism {
namespace {

/// Arguments of a reader of a type of line.
struct LineEntry {
  const std::string& name;
  const YamlValue& data;  ///< value of the type's key
  const PressureNode &from, &to;
  const Fluid& fluid;
  Model& model;
  Entry own() const { return {Section::hydraulics, name}; }
};

void read_orifice(const LineEntry& line) {
  const OrificeLaw law = read_orifice_law(line.data, line.fluid);
  const auto area = line.data.find("area");
  if (!area) {
    line.model.add(std::make_unique<Orifice>(line.name, line.from, line.to, law, read_area(line.data)), line.own());
    return;
  }
  if (const auto diameter = line.data.find("diameter")) diameter->fail("give `area` or `diameter`, not both");
  auto orifice = std::make_unique<Orifice>(line.name, line.from, line.to, law, 0);
  line.model.when_read(Model::Stage::formulas, [orifice = orifice.get(), formula = *area, &model = line.model] {
    orifice->read_area_formula(formula, model);
  });
  line.model.add(std::move(orifice), line.own());
}

void read_laminar(const LineEntry& line) {
  const auto given = line.data.find("conductance");
  double conductance = 0;
  if (given) {
    for (const char* key : {"length", "diameter"})
      if (const auto other = line.data.find(key)) other->fail("give `conductance`, or `length` and `diameter`");
    conductance = given->number();
  } else {  // law of Hagen and Poiseuille
    const double d = line.data.at("diameter").number();
    conductance = M_PI * d * d * d * d / (128 * line.fluid.viscosity * line.data.at("length").number());
  }
  line.model.add(std::make_unique<Leakage>(line.name, line.from, &line.to, conductance), line.own());
}

constexpr double usual_range = 0.1;  // opening range relative to the setting

double read_range(const YamlValue& entry, double setting) {
  const auto range = entry.find("range");
  if (range) return range->number();
  if (setting > 0) return usual_range * setting;
  return 0.5e5;
}

PoppetValve::Setting read_setting(const YamlValue& entry) {
  PoppetValve::Setting setting;
  setting.pressure = entry.at("pressure").number();
  setting.range = read_range(entry, setting.pressure);
  setting.area = read_area(entry);
  setting.time_constant = entry.at("time_constant").number();
  return setting;
}

void read_check(const LineEntry& line) {
  const PoppetValve::Setting setting = read_setting(line.data);
  line.model.add(std::make_unique<PoppetValve>("check", line.name, line.from, line.to, nullptr,
                                               read_orifice_law(line.data, line.fluid), setting),
                 line.own());
}

void read_relief(const LineEntry& line) {
  add_relief(line.name, line.data, line.from, line.to, line.fluid, line.own(), line.model);
}

void read_counterbalance(const LineEntry& line) {
  PoppetValve::Setting setting = read_setting(line.data);
  warn_of_setting(line.data.at("pressure"), setting.pressure);
  setting.back = 0;
  setting.pilot_ratio = line.data.at("pilot_ratio").number();
  setting.check_pressure = line.data.at("check_pressure").number();
  line.model.add(std::make_unique<PoppetValve>("counterbalance", line.name, line.from, line.to,
                                               &place_named_by(line.data.at("pilot"), line.model),
                                               read_orifice_law(line.data, line.fluid), setting),
                 line.own());
}

void read_flow_valve(const LineEntry& line) {
  const double least = line.data.at("pressure").number();
  warn_of_setting(line.data.at("pressure"), least);
  auto valve = std::make_unique<FlowValve>(line.name, line.from, line.to, least);
  line.model.when_read(Model::Stage::formulas, [valve = valve.get(), formula = line.data.at("flow"),
                                                &model = line.model] { valve->read(formula, model); });
  line.model.add(std::move(valve), line.own());
}

/// Reads the command after the model has been read, and adds the valve.
SpoolValve& add_spool_valve(std::unique_ptr<SpoolValve> valve, const YamlValue& entry, const Entry& own, Model& model) {
  SpoolValve& added = *valve;
  added.spool().read_dynamics(entry);
  model.when_read(Model::Stage::formulas, [&added, command = entry.at("command"), &model] {
    added.spool().read_command(command, model, added.formula_references());
  });
  model.add(std::move(valve), own);
  return added;
}

void read_valve(const LineEntry& line) {
  add_spool_valve(std::make_unique<SpoolValve>(line.name, line.from, line.to, read_orifice_law(line.data, line.fluid),
                                               read_area(line.data), line.data.at("overlap").number()),
                  line.data, line.own(), line.model);
}

// Adds volumes of fluid along the pipe, and segments between them. If the place at an end has its own pressure, the
// first cell ends there, and its middle is half a segment away. A place that is only an end of pipes (a junction)
// contains half a cell itself.
void read_pipe(const LineEntry& line) {
  const YamlValue& data = line.data;
  const double length = data.at("length").number(), diameter = data.at("diameter").number();
  const double k = data.at("roughness").number();
  if (k >= 0.1 * diameter) data.at("roughness").fail("expected a roughness well below the diameter");
  const int n = data.at("cells").integer();
  const double pressure = data.at("pressure").number(), vacuum = line.fluid.vacuum();
  if (!(pressure > vacuum))
    data.at("pressure").fail(fmt::format("expected a pressure above {:.6g} Pa, which is vacuum", vacuum));
  warn_of_pressure(data.at("pressure"), pressure, line.fluid);
  const std::array<const PressureNode*, 2> ends{&line.from, &line.to};
  std::array<bool, 2> holds{};
  for (std::size_t end : {0, 1}) holds[end] = ends[end]->type() == pipe_junction;
  const double cell = length / (n + 0.5 * holds[0] + 0.5 * holds[1]);
  const double space = 0.25 * M_PI * diameter * diameter * cell;
  double compliance = 0;
  if (const auto wall = data.find("wall"))  // a thin tube that is free to extend: dV/V = dp d/(E s)
    compliance = space * diameter / (wall->at("young").number() * wall->at("thickness").number());
  for (std::size_t end : {0, 1})
    if (holds[end]) volume_of(*ends[end], line.model)->add_volume(0.5 * space, 0.5 * compliance);
  const PressureNode* before = ends[0];
  const Entry segments{Section::hydraulics, line.name + ".segments"};
  for (int i = 0; i <= n; ++i) {
    const PressureNode* after = ends[1];
    if (i < n) {
      auto volume = std::make_unique<Volume>(line.name, line.fluid, space, pressure, compliance, pipe_cell);
      after = volume.get();
      line.model.add(std::move(volume), line.own(), Recorded::stacked);
    }
    const bool half = (i == 0 && !holds[0]) || (i == n && !holds[1]);
    line.model.add(std::make_unique<PipeSegment>(
                       line.name, *before, *after,
                       PipeData{half ? 0.5 * cell : cell, diameter, k, inertia_factor(line.fluid, pressure)}),
                   segments, Recorded::stacked);
    before = after;
  }
}

struct LineType {
  const char* key;
  void (*read)(const LineEntry& line);  ///< null: the type has four ports
  const KeyTable& (*keys)();
};
constexpr const char* four_ports = "servo_valve";
constexpr LineType line_table[] = {
    {"orifice", read_orifice, orifice_keys}, {"laminar", read_laminar, laminar_keys},
    {"check", read_check, check_valve_keys}, {"relief", read_relief, relief_keys},
    {"valve", read_valve, valve_keys},       {"counterbalance", read_counterbalance, counterbalance_keys},
    {"pipe", read_pipe, pipe_keys},          {"flow_valve", read_flow_valve, flow_valve_keys},
    {four_ports, nullptr, servo_valve_keys},
};

void read_four_ports(const std::string& name, const YamlValue& entry, const Fluid& fluid, Model& model) {
  for (const char* end : {"from", "to"})
    if (const auto value = entry.find(end)) value->fail("belongs to a line with two ends; a servo_valve has `ports`");
  const YamlValue ports = entry.at("ports");
  std::array<const PressureNode*, 4> places{};
  std::size_t count = 0;
  for (const char* port : {"P", "T", "A", "B"}) {
    const YamlValue value = ports.at(port);
    places[count] = &place_named_by(value, model);
    for (std::size_t other = 0; other < count; ++other)
      if (places[other] == places[count]) value.fail("another port is joined to this place as well");
    ++count;
  }
  add_servo_valve(name, entry.at(four_ports), places, fluid, {Section::hydraulics, name}, model);
}

}  // namespace

Volume* volume_of(const PressureNode& place, const Model& model) {
  for (Component* component : model.components_of({Section::hydraulics, place.name()}))
    if (component == &place) return dynamic_cast<Volume*>(component);
  return nullptr;
}

std::vector<std::string> line_types() {
  std::vector<std::string> types;
  for (const LineType& type : line_table) types.emplace_back(type.key);
  return types;
}

const KeyTable& line_keys() {
  static const KeyTable table{"a line", "A connection of places; one of its keys tells its type.", [] {
                                std::vector<Key> all = line_end_keys();
                                for (const LineType& type : line_table)
                                  all.emplace_back(type.key, keys::nested(type.keys), keys::optional,
                                                   type.keys().about);
                                return all;
                              }()};
  return table;
}

SpoolValve& add_servo_valve(const std::string& name, const YamlValue& entry,
                            const std::array<const PressureNode*, 4>& places, const Fluid& fluid, const Entry& own,
                            Model& model) {
  std::array<double, 4> areas{};
  if (const auto each = entry.find("areas")) {
    for (const char* key : {"area", "diameter"})
      if (const auto other = entry.find(key)) other->fail("give `areas` of the four edges, or one for all");
    if (!each->is_sequence() || each->size() != areas.size())
      each->fail("expected the areas of P-A, B-T, P-B and A-T at full opening");
    for (std::size_t k = 0; k < areas.size(); ++k) areas[k] = each->at(k).number();
  } else {
    areas.fill(read_area(entry));
  }
  return add_spool_valve(
      std::make_unique<SpoolValve>(name, places, read_orifice_law(entry, fluid), areas, entry.at("overlap").number()),
      entry, own, model);
}

void add_relief(const std::string& name, const YamlValue& entry, const PressureNode& from, const PressureNode& to,
                const Fluid& fluid, const Entry& own, Model& model) {
  PoppetValve::Setting setting = read_setting(entry);
  warn_of_setting(entry.at("pressure"), setting.pressure);
  if (entry.at("vented").boolean()) setting.back = 0;
  model.add(std::make_unique<PoppetValve>("relief", name, from, to, nullptr, read_orifice_law(entry, fluid), setting),
            own);
}

void read_line(const std::string& name, const YamlValue& entry, const Fluid& fluid, Model& model) {
  const LineType* type = nullptr;
  for (const LineType& each : line_table) {
    if (!entry.has(each.key)) continue;
    if (type)
      entry.at(each.key).fail(fmt::format("this line is a `{}` already; join two lines by a junction", type->key));
    type = &each;
  }
  if (!type) entry.fail(fmt::format("a line is one of: {}", fmt::join(line_types(), ", ")));
  if (!type->read) return read_four_ports(name, entry, fluid, model);
  if (const auto ports = entry.find("ports")) ports->fail("belongs to a servo_valve; a line has `from` and `to`");
  const YamlValue to = entry.at("to");
  const PressureNode &a = place_named_by(entry.at("from"), model), &b = place_named_by(to, model);
  if (&a == &b) to.fail("a line leads from one place to another");
  const YamlValue data = entry.at(type->key);
  type->read({name, data, a, b, fluid, model});
}

}  // namespace bielle::mechanism
