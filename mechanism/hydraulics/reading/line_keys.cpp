#include "mechanism/hydraulics/reading/line_keys.hpp"

#include "mechanism/hydraulics/lines/orifice_law.hpp"
#include "mechanism/hydraulics/lines/spool.hpp"

namespace bielle::mechanism {
namespace {

using namespace keys;

/// Returns the keys of valves whose opening follows the pressure.
std::vector<Key> poppet_keys() {
  return joined({valve_area_keys(),
                 {{"range", number("Pa").positive(), computed("a tenth of `pressure`, or 0.5 bar without it"),
                   "Pressure difference from closed to fully open."},
                  time_constant_key()},
                 orifice_law_keys()});
}

const KeyTable& wall_keys() {
  static const KeyTable table{"the wall of a pipe",
                              "Elastic wall of a thin tube that is free to extend.",
                              {{"thickness", number("m").positive(), required, "Thickness of the wall."},
                               {"young", number("Pa").positive(), required, "Young's modulus of the wall."}}};
  return table;
}

const KeyTable& port_keys() {
  static const KeyTable table{
      "the ports of a servo-valve",
      "Places that the ports of a servo-valve join.",
      {{"P", name_of("place of the hydraulics"), required, "Place of the supply."},
       {"T", name_of("place of the hydraulics"), required, "Place of the tank."},
       {"A", name_of("place of the hydraulics"), required, "Place that a positive command joins to P."},
       {"B", name_of("place of the hydraulics"), required, "Place that a positive command joins to T."}}};
  return table;
}

}  // namespace

const KeyTable& orifice_keys() {
  static const KeyTable table{
      "an orifice", "A hole, with turbulent flow at large pressure differences and laminar flow at small ones.",
      joined({area_keys(state_formula("m^2", {"t"}).non_negative(), "Area of the hole; with 0 nothing flows."),
              orifice_law_keys()})};
  return table;
}

const KeyTable& laminar_keys() {
  static const KeyTable table{
      "a laminar line",
      "A gap or a thin tube with laminar flow.",
      {{"conductance", number("m^3/(s Pa)").non_negative(), optional, "Flow per pressure difference."},
       {"length", number("m").positive(), optional,
        "Length of the tube, in place of `conductance`, by the law of Hagen and Poiseuille."},
       {"diameter", number("m").non_negative(), optional, "Diameter of the tube, in place of `conductance`."}}};
  return table;
}

const KeyTable& check_valve_keys() {
  static const KeyTable table{
      "a check valve", "A valve that lets fluid pass in one direction.",
      joined({{{"pressure", number("Pa").non_negative(), otherwise("0"), "Pressure difference at which it opens."}},
              poppet_keys()})};
  return table;
}

const KeyTable& relief_keys() {
  static const KeyTable table{
      "a relief valve", "A valve that opens at a pressure.",
      joined({{{"pressure", number("Pa").non_negative(), required, "Pressure difference at which it opens."},
               {"vented", boolean(), otherwise("false"), "Whether it opens by the pressure of `from` alone."}},
              poppet_keys()})};
  return table;
}

const KeyTable& counterbalance_keys() {
  static const KeyTable table{
      "a counterbalance valve", "A valve that holds a load until a pilot pressure helps to open it.",
      joined({{{"pressure", number("Pa").non_negative(), required, "Pressure of `from` at which it opens."},
               {"pilot", name_of("place of the hydraulics"), required, "Place whose pressure helps to open it."},
               {"pilot_ratio", number().non_negative(), required, "Factor of the pilot pressure."},
               {"check_pressure", number("Pa").non_negative(), otherwise("0"),
                "Pressure difference from `to` to `from` at which it lets fluid back."}},
              poppet_keys()})};
  return table;
}

const KeyTable& flow_valve_keys() {
  static const KeyTable table{
      "a flow valve",
      "A valve that passes a flow that is set, as soon as the pressure difference suffices.",
      {{"flow", state_formula("m^3/s", {"t"}), required, "Flow that is set."},
       {"pressure", number("Pa").positive(), required,
        "Pressure difference above which the flow passes completely, and below which less passes."}}};
  return table;
}

const KeyTable& valve_keys() {
  static const KeyTable table{
      "a valve", "A valve that a command opens.",
      joined({valve_area_keys(), spool_keys(0, "Commanded opening, as a share of the full one: from 0 to 1."),
              orifice_law_keys()})};
  return table;
}

const KeyTable& servo_valve_keys() {
  static const KeyTable table{
      "a servo-valve", "A valve with four ports and a spool that a command moves in both directions.",
      joined({valve_area_keys(),
              {{"areas", list_of(4, number("m^2").non_negative()), optional,
                "Areas of the edges P-A, B-T, P-B and A-T at full opening, in place of one area for all."}},
              spool_keys(-1,
                         "Commanded opening, as a share of the full one, from -1 to 1: positive values join P to A "
                         "and B to T, negative ones P to B and A to T."),
              orifice_law_keys()})};
  return table;
}

const KeyTable& pipe_keys() {
  static const KeyTable table{
      "a pipe",
      "A pipe with inertia and friction of the fluid, by Churchill's formula for all regimes.",
      {{"length", number("m").positive(), required, "Length of the pipe."},
       {"diameter", number("m").positive(), required, "Inner diameter."},
       {"roughness", number("m").non_negative(), otherwise("0"), "Roughness of the wall, well below the diameter."},
       {"cells", integer().between(1, 10000), otherwise("10"), "Number of volumes along the pipe."},
       {"pressure", number("Pa"), required, "Pressure at the start."},
       {"wall", nested(wall_keys), optional, "Elastic wall; without it the wall is rigid."}}};
  return table;
}

std::vector<Key> line_end_keys() {
  return {{"from", name_of("place of the hydraulics"), optional,
           "Place from which the line leads; required but for a servo_valve."},
          {"to", name_of("place of the hydraulics"), optional,
           "Place to which the line leads; required but for a servo_valve."},
          {"ports", nested(port_keys), optional, "Places of the four ports of a `servo_valve`, which requires them."},
          {"active", boolean(), otherwise("true"),
           "`false`: nothing flows through the orifice or valve until an action of an event activates it."}};
}

}  // namespace bielle::mechanism
