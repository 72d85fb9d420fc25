#include "mechanism/hydraulics/reading/actuator_reader.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mechanism/hydraulics/actuators/cushion.hpp"
#include "mechanism/hydraulics/actuators/cylinder.hpp"
#include "mechanism/hydraulics/circuit/places.hpp"
#include "mechanism/hydraulics/lines/orifice.hpp"
#include "mechanism/hydraulics/reading/accumulator_reader.hpp"
#include "mechanism/hydraulics/reading/line_reader.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

constexpr PlausibleRange plausible_piston{0, 10, "Areas are in m^2: a piston of 100 mm has 7.85e-3"};

/// Lists of stages, one for each chamber.
struct Pistons {
  std::vector<ChamberSpace::Stage> of[2];
  bool double_acting() const {
    for (const ChamberSpace::Stage& stage : of[1])
      if (stage.area > 0) return true;
    return false;
  }
};

class ActuatorReader {
 public:
  ActuatorReader(std::string name, const YamlValue& entry, Model& model)
      : name_(std::move(name)), entry_(entry), model_(model) {
    check_circuit();
    read_ambient_pressure(entry, fluid_);
    read_fluid(entry, fluid_);
    geometry_ = read_geometry();
    pistons_ = read_pistons();
    chambers_ = pistons_.double_acting() ? 2 : 1;
  }

  void read() {
    dead_ = read_two("dead_volumes");
    entry_.has("ports") ? read_joined() : read_lone();
  }

 private:
  /// Refuses keys of an own circuit, or of own chambers, for a cylinder in a shared circuit.
  void check_circuit() {
    if (!entry_.has("ports")) return;
    std::vector<std::string> own = keys::names_of(fluid_keys());
    for (const char* key : {"supply", "valve", "accumulator", "relief", "ambient_pressure"}) own.emplace_back(key);
    for (const std::string& key : own)
      if (const auto value = entry_.find(key))
        value->fail("belongs to an actuator with a circuit of its own; this one has `ports`: give it in `hydraulics`");
    if (entry_.has("cushions")) return;
    for (const char* key : {"pressures", "compliances"})
      if (const auto value = entry_.find(key))
        value->fail("belongs to chambers that are volumes of their own, and these open into `ports`: give it there");
  }

  Cylinder::Geometry read_geometry() {
    Cylinder::Geometry geometry;
    const YamlValue nodes = entry_.at("nodes");
    const std::vector<int> numbers = nodes_named_by(nodes, 2, model_);
    if (numbers[0] == numbers[1]) nodes.fail("a hydraulic_actuator joins two different nodes");
    geometry.node_a = numbers[0];
    geometry.node_b = numbers[1];
    const YamlValue at = entry_.at("at");
    if (!at.is_sequence() || at.size() != 2) at.fail("expected two points, one in the axes of each node");
    geometry.at_a = at.at(std::size_t{0}).vector3();
    geometry.at_b = at.at(std::size_t{1}).vector3();
    const Frame &A = model_.node(numbers[0]).frame, &B = model_.node(numbers[1]).frame;
    drawn_ = (B.x + B.R * geometry.at_b - A.x - A.R * geometry.at_a).norm();
    if (!(drawn_ > 0)) nodes.fail("the attachment points coincide: the hydraulic_actuator has no direction");
    const YamlValue stroke = entry_.at("stroke");
    if (!stroke.is_sequence() || stroke.size() != 2)
      stroke.fail("expected the shortest and the longest distance of the attachment points");
    const Eigen::VectorXd ends = stroke.vector();
    if (!(ends[0] < ends[1])) stroke.fail("expected the shortest distance first, then the longest");
    geometry.shortest = ends[0];
    geometry.longest = ends[1];
    constexpr double rounding = 1e-9;
    if (drawn_ < ends[0] * (1 - rounding) || drawn_ > ends[1] * (1 + rounding))
      stroke.fail(fmt::format("the attachment points are drawn {:.6g} m apart, which is outside", drawn_));
    if (const auto stops = entry_.find("end_stops")) {
      geometry.stop_stiffness = stops->at("stiffness").number();
      geometry.stop_damping = stops->at("damping").number();
      if (geometry.stop_stiffness == 0 && geometry.stop_damping > 0)
        stops->at("damping").fail("belongs to stops with a `stiffness` greater than 0: one of 0 is none");
    }
    if (const auto friction = entry_.find("friction")) geometry.friction = read_friction(*friction);
    return geometry;
  }

  /// Reads a friction force in newtons: a law with the normal force 1.
  static FrictionLaw read_friction(const YamlValue& entry) {
    FrictionLaw law;
    law.viscous = entry.at("viscous").number();
    law.kinetic = entry.at("coulomb").number();
    law.sticking = entry.has("static") ? entry.at("static").number() : law.kinetic;
    if (law.sticking < law.kinetic) entry.at("static").fail("expected no less than `coulomb`");
    const auto speed = entry.find("stribeck_velocity");
    if (law.sticking > law.kinetic && !speed)
      entry.at("static").fail("needs a `stribeck_velocity` over which it falls");
    law.stribeck_velocity = speed ? speed->number() : 0;
    if (law.sticking > law.kinetic && law.stribeck_velocity == 0)
      speed->fail("expected a rate greater than 0, over which the friction falls from `static` to `coulomb`");
    law.velocity = entry.at("velocity").number();
    return law;
  }

  Pistons read_pistons() {
    Pistons pistons;
    const double stroke = geometry_.longest - geometry_.shortest;
    const auto areas = entry_.find("piston_areas"), stages = entry_.find("stages");
    if (areas.has_value() == stages.has_value())
      entry_.fail("give `piston_areas`, or `stages` of a telescopic cylinder");
    const auto add = [&](const YamlValue& list, double length) {
      const Eigen::VectorXd two = list.vector();
      if (two.size() < 1 || two.size() > 2)
        list.fail("expected [A1, A2] in m^2: extending (greater than 0), and drawing in (0: a single-acting cylinder)");
      warn_outside(list, two[0], plausible_piston);
      pistons.of[0].push_back({two[0], length});
      pistons.of[1].push_back({two.size() == 2 ? two[1] : 0, length});
    };
    if (areas) {
      add(*areas, stroke);
      return pistons;
    }
    double sum = 0;
    for (const YamlValue& stage : stages->items()) {
      const double length = stage.at("length").number();
      add(stage.at("piston_areas"), length);
      sum += length;
    }
    if (pistons.of[0].empty()) stages->fail("expected at least one stage");
    if (std::abs(sum - stroke) > 1e-6 * stroke)
      stages->fail(fmt::format("the stages are {:.6g} m long together, the stroke {:.6g} m", sum, stroke));
    return pistons;
  }

  /// Reads a list of one number for each chamber.
  std::array<double, 2> read_two(const char* key) {
    const YamlValue list = entry_.at(key);
    const Eigen::VectorXd given = list.vector();
    if (given.size() != 2 && given.size() != static_cast<Eigen::Index>(chambers_))
      list.fail(
          fmt::format("expected {}, one for each chamber", chambers_ == 1 ? "a list of one number" : "two numbers"));
    return {given[0], given.size() == 2 ? given[1] : 0};
  }

  ChamberSpace space(std::size_t k) const {
    return {geometry_.shortest, dead_[k], k == 0 ? 1.0 : -1.0, pistons_.of[k]};
  }
  std::string part(const std::string& what) const { return name_ + "." + what; }
  static Entry circuit(const std::string& name) { return {Section::hydraulics, name}; }

  template <class T>
  T& add(std::unique_ptr<T> component, const std::string& name) {
    T& added = *component;
    model_.add(std::move(component), circuit(name));
    return added;
  }

  /// Adds a volume whose space is added later.
  Volume& add_volume(const std::string& name, std::optional<double> pressure, double compliance) {
    return add(std::make_unique<Volume>(name, fluid_, 0, pressure, compliance), name);
  }

  void check_space(std::size_t k, const YamlValue& place) const {
    const double V = space(k).at(drawn_).V;
    if (!(V > 0))
      place.fail(fmt::format("chamber {} has no space as drawn ({:.6g} m long): give it a dead volume", k + 1, drawn_));
  }

  YamlValue place_of_space() const { return entry_.find("dead_volumes") ? entry_.at("dead_volumes") : entry_; }

  /// Adds the cylinder itself, with its chambers, and the leakage.
  Cylinder& add_cylinder(const std::array<const PressureNode*, 2>& places) {
    auto cylinder = std::make_unique<Cylinder>(name_, geometry_, fluid_.ambient);
    for (std::size_t k = 0; k < chambers_; ++k) cylinder->add_chamber(*places[k], space(k));
    Cylinder& added = *cylinder;
    model_.add(std::move(cylinder), {Section::elements, name_});
    if (const auto leakage = entry_.find("leakage")) {
      const double conductance = leakage->number();
      if (chambers_ == 1)
        leakage->fail("leads from one chamber to the other, and there is only one: give `external_leakage`");
      if (conductance > 0)
        add(std::make_unique<Leakage>(part("leakage"), *places[0], places[1], conductance), part("leakage"));
    }
    const std::array<double, 2> outside = read_two("external_leakage");
    for (std::size_t k = 0; k < chambers_; ++k)
      if (outside[k] > 0) {
        const std::string name = part(fmt::format("external_leakage_{}", k + 1));
        add(std::make_unique<Leakage>(name, *places[k], nullptr, outside[k]), name);
      }
    return added;
  }

  // -- cushions

  /// Connects the chambers with the rest of the circuit, through their cushions or directly. A cushion's port is a
  /// junction of its own.
  /// @param ports  ports of the circuit; nullptr: none
  std::array<const PressureNode*, 2> add_cushions(const Cylinder& cylinder, const std::array<Volume*, 2>& chambers,
                                                  const std::array<const PressureNode*, 2>& ports = {}) {
    std::array<const PressureNode*, 2> ends{chambers[0], chambers[1]};
    const auto cushions = entry_.find("cushions");
    if (!cushions) return ends;
    const auto list = [&](const char* key) {
      const YamlValue given = cushions->at(key);
      if (!given.is_sequence() || given.size() != chambers_) given.fail("expected a number for each chamber");
      return given.vector();
    };
    const Eigen::VectorXd lengths = list("lengths"), areas = list("areas");
    const double port_area = cushions->at("port_area").number();
    for (std::size_t k = 0; k < chambers_; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (areas[i] >= port_area) cushions->at("areas").fail("expected areas smaller than the port_area");
      if (lengths[i] > geometry_.longest - geometry_.shortest) cushions->at("lengths").fail("longer than the stroke");
      const std::string port = part(fmt::format("port_{}", k + 1)), name = part(fmt::format("cushion_{}", k + 1));
      ends[k] = ports[k];
      if (!ends[k])
        ends[k] = &add(std::make_unique<Junction>(port, fluid_, chambers[k]->start().value_or(fluid_.ambient)), port);
      const Cushion::Data data{port_area, areas[i], lengths[i], k == 0 ? geometry_.shortest : geometry_.longest,
                               k == 0 ? 1.0 : -1.0};
      add(std::make_unique<Cushion>(name, cylinder, *chambers[k], *ends[k], read_orifice_law(*cushions, fluid_), data),
          name);
    }
    return ends;
  }

  // -- with a shared circuit

  void read_joined() {
    const YamlValue ports = entry_.at("ports");
    if (!ports.is_sequence() || ports.size() != chambers_)
      ports.fail(chambers_ == 1
                     ? "expected a list of one place of the hydraulics: the cylinder is single-acting"
                     : "expected two places of the hydraulics: of the chamber that extends, and of the other");
    std::array<const PressureNode*, 2> places{};
    std::array<Volume*, 2> volumes{};
    for (std::size_t k = 0; k < chambers_; ++k) {
      places[k] = &place_named_by(ports.at(k), model_);
      fluid_ = places[k]->fluid();
    }
    if (chambers_ == 2 && places[0] == places[1]) ports.fail("both chambers open into the same place");
    if (entry_.has("cushions")) return read_cushioned(places);
    for (std::size_t k = 0; k < chambers_; ++k) {
      const YamlValue item = ports.at(k);
      volumes[k] = volume_of(*places[k], model_);
      if (volumes[k]) {
        volumes[k]->add_room(space(k).at(drawn_).V);
      } else if (!places[k]->is_given()) {
        item.fail(
            fmt::format("'{}' is a junction, and has no room for a chamber: list it under `volumes`", item.text()));
      }
    }
    Cylinder& cylinder = add_cylinder(places);
    bool free = true;
    for (std::size_t k = 0; k < chambers_; ++k) free = free && volumes[k] && volumes[k]->load_decides();
    if (!free) return;
    for (std::size_t k = 0; k < chambers_; ++k) volumes[k]->start_by_load();
    cylinder.balance(fluid_.ambient);
  }

  /// Reads a cylinder with cushions, which are between its chambers and the places of the circuit.
  void read_cushioned(const std::array<const PressureNode*, 2>& places) {
    const std::array<Volume*, 2> volumes = add_chambers();
    Cylinder& cylinder = add_cylinder({volumes[0], volumes[1]});
    add_cushions(cylinder, volumes, places);
    if (!entry_.has("pressures")) cylinder.balance(fluid_.ambient);
  }

  // -- with its own circuit

  void read_lone() {
    const std::array<Volume*, 2> volumes = add_chambers();
    Cylinder& cylinder = add_cylinder({volumes[0], volumes[1]});
    const double tank = add_supply(volumes, add_cushions(cylinder, volumes));
    if (!entry_.has("pressures")) cylinder.balance(tank);
  }

  /// Adds its chambers as volumes of their own, with the start pressures.
  std::array<Volume*, 2> add_chambers() {
    const auto pressures = entry_.find("pressures");
    std::array<std::optional<double>, 2> start;
    if (pressures) {
      const Eigen::VectorXd list = pressures->vector();
      if (list.size() != 2 && list.size() != static_cast<Eigen::Index>(chambers_))
        pressures->fail("expected a pressure [Pa] for each chamber");
      const double vacuum = fluid_.vacuum();
      for (std::size_t k = 0; k < chambers_; ++k) {
        start[k] = list[static_cast<Eigen::Index>(k)];
        if (!(*start[k] > vacuum))
          pressures->fail(fmt::format("expected pressures above {:.6g} Pa, which is vacuum", vacuum));
        warn_of_pressure(pressures->at(k), *start[k], fluid_);
      }
    }
    const std::array<double, 2> compliances = read_two("compliances");
    std::array<Volume*, 2> volumes{};
    for (std::size_t k = 0; k < chambers_; ++k) {
      check_space(k, place_of_space());
      volumes[k] = &add_volume(part(fmt::format("chamber_{}", k + 1)), start[k], compliances[k]);
      volumes[k]->add_room(space(k).at(drawn_).V);
    }
    return volumes;
  }

  /// Adds supply, tank, valve, accumulator and relief valves. @returns the pressure of the tank
  double add_supply(const std::array<Volume*, 2>& volumes, const std::array<const PressureNode*, 2>& ends) {
    const auto supply = entry_.find("supply"), valve = entry_.find("valve"), relief = entry_.find("relief"),
               accumulator = entry_.find("accumulator");
    double tank_pressure = fluid_.ambient;
    PressureSource* tank = nullptr;
    const PressureNode* pump = nullptr;
    Volume* pump_volume = nullptr;
    if (supply) {
      if (const auto given = supply->find("tank")) tank_pressure = given->number();
    }
    if (supply || relief)
      tank = &add_source("tank", supply && supply->has("tank") ? supply->at("tank") : std::optional<YamlValue>());
    if (supply) {
      const auto pressure = supply->find("pressure"), flow = supply->find("flow");
      if (pressure.has_value() == flow.has_value())
        supply->fail("give `pressure` [Pa] or `flow` [m^3/s]: one of the two");
      if (pressure) {
        if (const auto volume = supply->find("volume")) volume->fail("belongs to a supply of `flow`");
        pump = &add_source("supply", *pressure);
      } else {
        pump_volume =
            &add(std::make_unique<Volume>(part("supply"), fluid_, supply->at("volume").number(), tank_pressure, 0),
                 part("supply"));
        pump = pump_volume;
        auto source = std::make_unique<FlowSource>(part("pump"), tank, *pump);
        model_.when_read(Model::Stage::formulas, [source = source.get(), formula = *flow, this_model = &model_] {
          source->read(formula, *this_model);
        });
        add(std::move(source), part("pump"));
      }
    }
    if (valve) {
      if (!supply) valve->fail("needs a `supply`");
      add_servo_valve(part("valve"), *valve, {pump, tank, ends[0], chambers_ == 2 ? ends[1] : nullptr}, fluid_,
                      circuit(part("valve")), model_);
    } else if (supply) {
      supply->fail("leads nowhere: give a `valve`");
    }
    if (relief) {
      // A pump of constant flow fills its own volume, whose pressure is limited; otherwise the pressures of the
      // chambers are limited.
      if (pump_volume)
        add_relief(part("relief"), *relief, *pump, *tank, fluid_, circuit(part("relief")), model_);
      else
        for (std::size_t k = 0; k < chambers_; ++k) {
          const std::string name = part(fmt::format("relief_{}", k + 1));
          add_relief(name, *relief, *volumes[k], *tank, fluid_, circuit(name), model_);
        }
    }
    if (accumulator) {
      add_accumulator(part("accumulator"), *accumulator, pump_volume ? *pump_volume : *volumes[0],
                      circuit(part("accumulator")), model_);
    }
    return tank_pressure;
  }

  PressureSource& add_source(const std::string& what, const std::optional<YamlValue>& formula) {
    PressureSource& source = add(std::make_unique<PressureSource>(part(what), fluid_), part(what));
    if (formula)
      model_.when_read(Model::Stage::formulas,
                       [&source, formula = *formula, this_model = &model_] { source.read(formula, *this_model); });
    else
      source.keep(fluid_.ambient);
    return source;
  }

  std::string name_;
  const YamlValue& entry_;
  Model& model_;
  Fluid fluid_;
  Cylinder::Geometry geometry_;
  Pistons pistons_;
  std::size_t chambers_ = 2;
  std::array<double, 2> dead_{0, 0};
  double drawn_ = 0;  ///< initial length [m]
};

}  // namespace

void read_hydraulic_actuator(const std::string& name, const YamlValue& entry, Model& model) {
  ActuatorReader(name, entry, model).read();
}

}  // namespace bielle::mechanism
