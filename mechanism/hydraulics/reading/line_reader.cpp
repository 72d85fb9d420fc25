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

std::vector<std::string> joined(std::vector<std::string> keys, const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

void read_orifice(const LineEntry& line) {
  line.data.check_keys(joined({"area", "diameter"}, orifice_law_keys()), "an orifice");
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
  line.data.check_keys({"conductance", "length", "diameter"}, "a laminar line");
  const auto given = line.data.find("conductance");
  double conductance = 0;
  if (given) {
    for (const char* key : {"length", "diameter"})
      if (const auto other = line.data.find(key)) other->fail("give `conductance`, or `length` and `diameter`");
    conductance = given->non_negative_number();
  } else {  // law of Hagen and Poiseuille
    const double d = line.data.at("diameter").non_negative_number();
    conductance = M_PI * d * d * d * d / (128 * line.fluid.viscosity * line.data.at("length").positive_number());
  }
  line.model.add(std::make_unique<Leakage>(line.name, line.from, &line.to, conductance), line.own());
}

constexpr double usual_range = 0.1;  // opening range relative to the setting

double read_range(const YamlValue& entry, double setting) {
  const auto range = entry.find("range");
  if (range) return range->positive_number();
  if (setting > 0) return usual_range * setting;
  return 0.5e5;
}

double read_time_constant(const YamlValue& entry) {
  const auto constant = entry.find("time_constant");
  return constant ? constant->non_negative_number() : 0;
}

const std::vector<std::string> poppet_keys = {"area", "diameter", "range", "time_constant"};

void read_check(const LineEntry& line) {
  line.data.check_keys(joined(joined({"pressure"}, poppet_keys), orifice_law_keys()), "a check valve");
  PoppetValve::Setting setting;
  const auto pressure = line.data.find("pressure");
  setting.pressure = pressure ? pressure->non_negative_number() : 0;
  setting.range = read_range(line.data, setting.pressure);
  setting.area = read_area(line.data);
  setting.time_constant = read_time_constant(line.data);
  line.model.add(std::make_unique<PoppetValve>("check", line.name, line.from, line.to, nullptr,
                                               read_orifice_law(line.data, line.fluid), setting),
                 line.own());
}

void read_relief(const LineEntry& line) {
  add_relief(line.name, line.data, line.from, line.to, line.fluid, line.own(), line.model);
}

void read_counterbalance(const LineEntry& line) {
  line.data.check_keys(
      joined(joined({"pressure", "pilot", "pilot_ratio", "check_pressure"}, poppet_keys), orifice_law_keys()),
      "a counterbalance valve");
  PoppetValve::Setting setting;
  setting.pressure = line.data.at("pressure").non_negative_number();
  warn_of_setting(line.data.at("pressure"), setting.pressure);
  setting.range = read_range(line.data, setting.pressure);
  setting.area = read_area(line.data);
  setting.back = 0;
  setting.time_constant = read_time_constant(line.data);
  setting.pilot_ratio = line.data.at("pilot_ratio").non_negative_number();
  const auto check = line.data.find("check_pressure");
  setting.check_pressure = check ? check->non_negative_number() : 0;
  line.model.add(std::make_unique<PoppetValve>("counterbalance", line.name, line.from, line.to,
                                               &place_named_by(line.data.at("pilot"), line.model),
                                               read_orifice_law(line.data, line.fluid), setting),
                 line.own());
}

void read_flow_valve(const LineEntry& line) {
  line.data.check_keys({"flow", "pressure"}, "a flow valve");
  const double least = line.data.at("pressure").positive_number();
  warn_of_setting(line.data.at("pressure"), least);
  auto valve = std::make_unique<FlowValve>(line.name, line.from, line.to, least);
  line.model.when_read(Model::Stage::formulas, [valve = valve.get(), formula = line.data.at("flow"),
                                                &model = line.model] { valve->read(formula, model); });
  line.model.add(std::move(valve), line.own());
}

double read_overlap(const YamlValue& entry) {
  const auto overlap = entry.find("overlap");
  if (!overlap) return 0;
  const double share = overlap->number();
  if (!(share > -1 && share < 1)) overlap->fail("expected a share of the full opening between -1 and 1");
  return share;
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
  line.data.check_keys(joined(joined({"area", "diameter", "overlap"}, orifice_law_keys()), spool_keys()), "a valve");
  add_spool_valve(std::make_unique<SpoolValve>(line.name, line.from, line.to, read_orifice_law(line.data, line.fluid),
                                               read_area(line.data), read_overlap(line.data)),
                  line.data, line.own(), line.model);
}

// Adds volumes of fluid along the pipe, and segments between them. A place with its own pressure is at the end of the
// first cell, half a segment from its middle; a place that is only an end of pipes (a junction) contains half a cell
// itself.
void read_pipe(const LineEntry& line) {
  const YamlValue& data = line.data;
  data.check_keys({"length", "diameter", "roughness", "cells", "pressure", "wall"}, "a pipe");
  const double length = data.at("length").positive_number(), diameter = data.at("diameter").positive_number();
  const auto roughness = data.find("roughness"), cells = data.find("cells"), wall = data.find("wall");
  const double k = roughness ? roughness->non_negative_number() : 0;
  if (k >= 0.1 * diameter) roughness->fail("expected a roughness well below the diameter");
  const int n = cells ? cells->integer() : 10;
  if (n < 1 || n > 10000) cells->fail("expected 1 to 10000 volumes along the pipe");
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
  if (wall) {  // a thin tube that is free to extend: dV/V = dp d/(E s)
    wall->check_keys({"thickness", "young"}, "the wall of a pipe");
    compliance = space * diameter / (wall->at("young").positive_number() * wall->at("thickness").positive_number());
  }
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
  void (*read)(const LineEntry& line);
};
constexpr LineType line_table[] = {
    {"orifice", read_orifice}, {"laminar", read_laminar},       {"check", read_check},
    {"relief", read_relief},   {"valve", read_valve},           {"counterbalance", read_counterbalance},
    {"pipe", read_pipe},       {"flow_valve", read_flow_valve},
};
constexpr const char* four_ports = "servo_valve";

void read_four_ports(const std::string& name, const YamlValue& entry, const Fluid& fluid, Model& model) {
  entry.check_keys({"ports", four_ports}, "a line with a servo-valve");
  const YamlValue ports = entry.at("ports");
  ports.check_keys({"P", "T", "A", "B"}, "the ports of a servo-valve");
  std::array<const PressureNode*, 4> places{};
  std::size_t count = 0;
  for (const char* port : {"P", "T", "A", "B"}) {
    const YamlValue value = ports.at(port);
    places[count] = &place_named_by(value, model);
    for (std::size_t other = 0; other < count; ++other)
      if (places[other] == places[count]) value.fail("another port is joined to this place as well");
    ++count;
  }
  const YamlValue data = entry.at(four_ports);
  data.check_keys(servo_valve_keys(), "a servo-valve");
  add_servo_valve(name, data, places, fluid, {Section::hydraulics, name}, model);
}

}  // namespace

Volume* volume_of(const PressureNode& place, const Model& model) {
  for (Component* component : model.components_of({Section::hydraulics, place.name()}))
    if (component == &place) return dynamic_cast<Volume*>(component);
  return nullptr;
}

std::vector<std::string> line_types() {
  std::vector<std::string> keys;
  for (const LineType& type : line_table) keys.emplace_back(type.key);
  keys.emplace_back(four_ports);
  return keys;
}

std::vector<std::string> servo_valve_keys() {
  return joined(joined({"area", "areas", "diameter", "overlap"}, orifice_law_keys()), spool_keys());
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
    for (std::size_t k = 0; k < areas.size(); ++k) areas[k] = each->at(k).non_negative_number();
  } else {
    areas.fill(read_area(entry));
  }
  return add_spool_valve(
      std::make_unique<SpoolValve>(name, places, read_orifice_law(entry, fluid), areas, read_overlap(entry)), entry,
      own, model);
}

void add_relief(const std::string& name, const YamlValue& entry, const PressureNode& from, const PressureNode& to,
                const Fluid& fluid, const Entry& own, Model& model) {
  entry.check_keys(joined(joined({"pressure", "vented"}, poppet_keys), orifice_law_keys()), "a relief valve");
  PoppetValve::Setting setting;
  setting.pressure = entry.at("pressure").non_negative_number();
  warn_of_setting(entry.at("pressure"), setting.pressure);
  setting.range = read_range(entry, setting.pressure);
  setting.area = read_area(entry);
  setting.time_constant = read_time_constant(entry);
  const auto vented = entry.find("vented");
  if (vented && vented->boolean()) setting.back = 0;
  model.add(std::make_unique<PoppetValve>("relief", name, from, to, nullptr, read_orifice_law(entry, fluid), setting),
            own);
}

void read_line(const std::string& name, const YamlValue& entry, const Fluid& fluid, Model& model) {
  if (entry.has(four_ports)) return read_four_ports(name, entry, fluid, model);
  std::vector<std::string> keys = {"from", "to", "ports"};
  const LineType* type = nullptr;
  for (const LineType& each : line_table) {
    keys.emplace_back(each.key);
    if (!entry.has(each.key)) continue;
    if (type)
      entry.at(each.key).fail(fmt::format("this line is a `{}` already; join two lines by a junction", type->key));
    type = &each;
  }
  keys.emplace_back(four_ports);
  entry.check_keys(keys, "a line");
  if (!type) entry.fail(fmt::format("a line is one of: {}", fmt::join(line_types(), ", ")));
  if (const auto ports = entry.find("ports")) ports->fail("belongs to a servo_valve; a line has `from` and `to`");
  const YamlValue to = entry.at("to");
  const PressureNode &a = place_named_by(entry.at("from"), model), &b = place_named_by(to, model);
  if (&a == &b) to.fail("a line leads from one place to another");
  const YamlValue data = entry.at(type->key);
  type->read({name, data, a, b, fluid, model});
}

}  // namespace bielle::mechanism
