// Keys of hydraulic actuators.
#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "mechanism/hydraulics/lines/orifice_law.hpp"
#include "mechanism/hydraulics/reading/accumulator_reader.hpp"
#include "mechanism/hydraulics/reading/actuator_reader.hpp"
#include "mechanism/hydraulics/reading/line_keys.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
namespace {

using namespace keys;

KeyForms piston_areas_forms() {
  const KeyForm extending = number("m^2").positive();
  return {tuple({{extending}, {number("m^2").non_negative()}}), list_of(1, extending)};
}

/// Returns the form of lists of a number for each chamber.
KeyForms for_each_chamber(const char* unit) {
  const KeyForm value = number(unit).non_negative();
  return {list_of(2, value), list_of(1, value)};
}

const KeyTable& stage_keys() {
  static const KeyTable table{
      "a stage",
      "A stage of a telescopic cylinder.",
      {{"piston_areas", piston_areas_forms(), required,
        "Areas on which the pressures of the chambers act, [A1, A2]: extending, and drawing in (0: single-acting)."},
       {"length", number("m").positive(), required, "Part of the stroke in which the stage extends."}}};
  return table;
}

const KeyTable& end_stop_keys() {
  static const KeyTable table{
      "the end_stops",
      "Stops at both ends of the stroke.",
      {{"stiffness", number("N/m").non_negative(), required, "Force per displacement past the end; 0 is no stop."},
       {"damping", number("N s/m").non_negative(), otherwise("0"), "Force per rate past the end."}}};
  return table;
}

const KeyTable& friction_keys() {
  static const KeyTable table{
      "the friction of an actuator",
      "Friction of the seals.",
      {{"viscous", number("N s/m").non_negative(), otherwise("0"), "Force per rate of the length."},
       {"coulomb", number("N").non_negative(), otherwise("0"), "Friction force when it slides."},
       {"static", number("N").non_negative(), computed("that of `coulomb`"), "Friction force when it sticks."},
       {"stribeck_velocity", number("m/s").non_negative(), computed("0; required if `static` exceeds `coulomb`"),
        "Rate over which the friction force falls from `static` to `coulomb`."},
       {"velocity", number("m/s").positive(), otherwise("1e-3"),
        "Rate over which the friction force changes its sign smoothly."}}};
  return table;
}

const KeyTable& actuator_supply_keys() {
  static const KeyTable table{
      "the supply of an actuator",
      "A supply of given pressure, or a pump of given flow into a volume.",
      {{"pressure", state_formula("Pa", {"t"}), optional, "Pressure of the supply for any flow."},
       {"flow", state_formula("m^3/s", {"t"}), optional, "Flow of a pump, in place of `pressure`."},
       {"volume", number("m^3").positive(), optional, "Volume into which the pump delivers; required with `flow`."},
       {"tank", number("Pa"), computed("the ambient pressure"), "Pressure of the tank."}}};
  return table;
}

const KeyTable& cushion_keys() {
  static const KeyTable table{
      "the cushions",
      "Outlets of the chambers, which narrow from `port_area` to `areas` over the last `lengths` of the stroke. Inflow "
      "is not throttled.",
      joined({{{"lengths", for_each_chamber("m"), required, "Lengths of the stroke over which the outlets narrow."},
               {"areas", for_each_chamber("m^2"), required, "Areas of the outlets at the ends of the stroke."},
               {"port_area", number("m^2").positive(), required, "Area of each port."}},
              orifice_law_keys()})};
  return table;
}

}  // namespace

const KeyTable& hydraulic_actuator_keys() {
  static const KeyTable table{
      "a hydraulic_actuator", "A cylinder between points of two nodes, in a circuit or with a circuit of its own.",
      joined({{type_key(),
               {"nodes", list_of(2, name_of("node")), required, "The two nodes, which chamber 1 pushes apart."},
               {"at", list_of(2, vector3("m").as_point()), otherwise("[[0, 0, 0], [0, 0, 0]]"),
                "Points of attachment, each in the axes of its node."},
               {"stroke", list_of(2, number("m").positive()), required,
                "Shortest and longest distance of the points of attachment."},
               {"piston_areas", piston_areas_forms(), optional,
                "Areas on which the pressures of the chambers act, [A1, A2]: extending, and drawing in (0: "
                "single-acting)."},
               {"stages", list_of(nested(stage_keys)).items_at_least(1), optional,
                "Stages of a telescopic cylinder in the order in which they extend, in place of `piston_areas`."},
               {"dead_volumes", for_each_chamber("m^3"), otherwise("[0, 0]"),
                "Dead volume of each chamber, hoses included."},
               {"leakage", number("m^3/(s Pa)").non_negative(), otherwise("0"),
                "Leakage between the chambers: flow per pressure difference."},
               {"external_leakage", for_each_chamber("m^3/(s Pa)"), otherwise("[0, 0]"),
                "Leakage from each chamber to the outside: flow per pressure difference."},
               {"friction", nested(friction_keys), optional, "Friction of the seals; none without the key."},
               {"end_stops", nested(end_stop_keys), optional,
                "Stops at both ends of the stroke, which push as stops of joints do. Without them the summary reports "
                "an actuator that left its stroke."},
               {"ports", list_of(name_of("place of the hydraulics")), optional,
                "Places of the hydraulics to which the chambers are connected, in place of a circuit of its own: the "
                "keys of that circuit then do not apply, except those of chambers behind `cushions`."},
               {"pressures",
                {list_of(2, number("Pa")), list_of(1, number("Pa"))},
                computed("in equilibrium with the load"),
                "Pressures at the start of the chambers that are volumes of its own: without `ports`, or behind "
                "`cushions`. By default the length is not accelerated, and the chamber that carries less is at the "
                "pressure of the tank."},
               {"compliances", for_each_chamber("m^3/Pa"), otherwise("[0, 0]"),
                "Compliance of each chamber and its hose: growth of the volume per pressure."},
               {"cushions", nested(cushion_keys), optional,
                "Throttles at the ends of the stroke; none without the key. With `ports`, chambers behind them are "
                "volumes of their own, with `pressures` and `compliances`."},
               {"supply", nested(actuator_supply_keys), optional,
                "Supply of the own circuit: a given pressure, or a pump of given flow."},
               {"valve", nested(servo_valve_keys), optional,
                "Servo-valve between supply, tank and chambers; three of its ports are used for a single-acting "
                "cylinder."},
               {"relief", nested(relief_keys), optional,
                "Relief valve to the tank, for a pump of constant flow or for each chamber."},
               {"accumulator", nested(own_accumulator_keys), optional,
                "Accumulator at a pump of constant flow, or at chamber 1."},
               ambient_pressure_key()},
              fluid_keys()})};
  return table;
}

}  // namespace bielle::mechanism
