// Samples of hydraulics: places, lines, accumulators, machines, cylinders. The fluid is soft (B = 1e5 Pa) and volumes
// are large, so that pressures, flows and spaces of order one change each other by as much.
//
// No component has a closed power balance by itself: the power that a cylinder takes from the motion is in the energy
// of the fluid, which belongs to another component. Circuits as a whole balance (tests/benchmarks/hydraulics).
#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

const std::string soft =
    "  ambient_pressure: 0\n"
    "  fluid: {bulk_modulus: 1e5, density: 1e4, viscosity: 30, air_fraction: 0.1, air_exponent: 1.3}\n";

/// Returns two nodes far enough apart for a cylinder, a hinge between them, and places of the circuit.
std::string circuit(const std::string& text, const std::string& fluid = soft) {
  return R"yaml(
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 1.4], rotation_vector: [-0.7, 0.2, 0.4]}
joints:
  axle: {type: hinge, nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3]}
hydraulics:
)yaml" + fluid +
         "  volumes:\n    p: {volume: 5, pressure: 1}\n    t: {volume: 6, pressure: 0.2}\n"
         "    x: {volume: 7, pressure: -1}\n" +
         text;
}

Sample part(const std::string& section, const std::string& type, const std::string& variant, const std::string& model,
            std::vector<BadValue> bad) {
  Sample sample{Section::hydraulics, type, variant, model, std::move(bad)};
  sample.place = "hydraulics." + section;
  sample.has_no_power = true;
  return sample;
}

Sample line(const std::string& type, const std::string& variant, const std::string& keys, std::vector<BadValue> bad,
            const std::string& fluid = soft) {
  bad.push_back({"from", "q", "no place of the hydraulics"});
  bad.push_back({"to", "p", "from one place to another"});
  bad.push_back({type, "", "a line is one of"});
  return part("lines", type, variant,
              circuit("  lines:\n    it: {from: p, to: t, " + type + ": {" + keys + "}}\n", fluid), std::move(bad));
}

std::vector<BadValue> within(const std::string& type, const std::vector<BadValue>& list) {
  std::vector<BadValue> bad;
  for (const BadValue& each : list) bad.push_back({type + "." + each.key, each.value, each.says});
  return bad;
}

const std::string law = "coefficient: 0.7, density: 1.5";
const std::string conserving =
    "  ambient_pressure: 0\n  fluid: {bulk_modulus: 1e5, density: 1, conserves: mass, vapour_pressure: 3000}\n";

/// A valve whose opening follows is closed at the reference, at the kink of its lower limit.
Sample following(Sample sample) {
  sample.scales.kinks_unloaded = true;
  return sample;
}

/// Returns a line whose formula reads another one, which has a formula itself.
Sample reader(const std::string& type, const std::string& variant, const std::string& it, const std::string& other,
              std::vector<BadValue> bad) {
  bad.push_back({"from", "other", "no place of the hydraulics"});
  bad.push_back({"to", "p", "from one place to another"});
  bad.push_back({type, "", "a line is one of"});
  return part("lines", type, variant,
              circuit("  lines:\n    other: {from: x, to: t, " + other + "}\n    it: {from: p, to: t, " + it + "}\n"),
              std::move(bad));
}

std::vector<Sample> lines() {
  return {
      line("orifice", "area by a formula", law + ", area: \"0.3 + 0.1*sin(axle.angle + t)\", transition_pressure: 2",
           within("orifice", {{"area", "axle.angel", "did you mean 'angle'"}})),
      line("orifice", "by Reynolds number", law + ", diameter: 0.5, transition_reynolds: 1e-2", within("orifice", {}),
           conserving),
      line("laminar", "", "conductance: 0.3", {}),
      line("laminar", "a gap", "length: 2, diameter: 3", {{"laminar.length", "", "length"}}, conserving),
      line("check", "", law + ", area: 0.4, pressure: 0.2, range: 3, transition_pressure: 2", within("check", {})),
      following(line("relief", "that follows",
                     law + ", diameter: 0.4, pressure: 0.2, range: 3, time_constant: 0.7, transition_reynolds: 0.1",
                     within("relief", {}))),
      line("relief", "vented", law + ", area: 0.4, pressure: 0.2, range: 5, vented: true, transition_pressure: 1",
           within("relief", {})),
      following(line("counterbalance", "",
                     law + ", area: 0.4, pressure: 0.1, pilot: x, pilot_ratio: 0.7, range: 5, check_pressure: 0.3, "
                           "time_constant: 0.3, "
                           "transition_pressure: 2",
                     within("counterbalance", {{"pilot", "y", "no place"}}))),
      line("flow_valve", "", "flow: \"0.3 + 0.1*axle.angle.rate^2 + 0.1*t\", pressure: 3", {}),
      reader("flow_valve", "that reads another line", "flow_valve: {flow: \"0.2 + 0.3*other.flow\", pressure: 3}",
             "flow_valve: {flow: \"0.3 + 0.1*axle.angle\", pressure: 2}",
             {{"flow_valve.flow", "other.flaw", "did you mean"}}),
      reader("orifice", "of the opening of another line",
             "orifice: {" + law + ", area: \"0.3 + 0.2*other.opening\", transition_pressure: 2}",
             "valve: {" + law + ", area: 0.5, command: \"0.4 + 0.1*axle.angle\", transition_pressure: 1}",
             within("orifice", {{"area", "other.openin", "did you mean"}})),
      line("valve", "second order",
           law + ", area: 0.5, overlap: -0.3, command: \"0.3*axle.angle + 0.01*t\", frequency: 0.4, damping: 0.6, "
                 "transition_pressure: 1",
           within("valve", {{"command", "axle.angel", "did you mean"}})),
      line("pipe", "",
           "length: 3, diameter: 2, roughness: 0.01, cells: 2, pressure: 0, wall: {thickness: 0.1, young: 1e6}",
           {{"pipe.roughness", "1", "well below"}})};
}

Sample servo_valve(const std::string& variant, const std::string& keys, std::vector<BadValue> bad) {
  for (const BadValue& each : std::vector<BadValue>{{"ports", "", "ports"},
                                                    {"ports.T", "p", "another port"},
                                                    {"ports.A", "nowhere", "no place"},
                                                    {"ports.B", "nowhere", "no place"},
                                                    {"servo_valve", "", "a line is one of"}})
    bad.push_back(each);
  return part("lines", "servo_valve", variant,
              circuit("    b: {volume: 4, pressure: 2}\n  lines:\n    it: {ports: {P: p, T: t, A: x, B: b}, "
                      "servo_valve: {" +
                      keys + "}}\n"),
              std::move(bad));
}

std::vector<Sample> places() {
  std::vector<Sample> list = {
      part("volumes", "volume", "", circuit("    it: {volume: 5, pressure: 1, compliance: 3e-5}\n"),
           {{"pressure", "-2e5", "vacuum"}}),
      part("volumes", "volume", "without air", circuit("    it: {volume: 5, pressure: 3e4}\n", conserving),
           {{"volume", "0", "has no space as drawn"}, {"pressure", "-2e5", "vacuum"}}),
      part("supplies", "supply", "pressure", circuit("  supplies:\n    it: {pressure: \"1 + axle.angle + t\"}\n"),
           {{"pressure", "", "one of the two"}}),
      part("supplies", "supply", "flow",
           circuit("  supplies:\n    it: {to: p, from: t, flow: \"1 + axle.angle.rate + t\"}\n"),
           {{"to", "", "to"}, {"from", "nowhere", "no place"}, {"flow", "", "one of the two"}}),
      part("accumulators", "accumulator", "",
           circuit("  accumulators:\n    it: {at: p, gas_volume: 3, precharge: -5, exponent: 1.3}\n"),
           {{"at", "nowhere", "no place"}, {"precharge", "-2e5", "vacuum"}}),
      part("machines", "machine", "",
           circuit("  machines:\n    it: {joint: axle, from: p, to: t, displacement: 0.3, setting: \"0.7 + "
                   "0.1*sin(axle.angle + axle.angle.rate)\", leakage: 0.2, drag: 0.4}\n"),
           {{"joint", "axel", "did you mean"},
            {"from", "nowhere", "no place"},
            {"to", "p", "from one place to another"},
            {"setting", "axle.angel", "did you mean"}}),
      part(
          "machines", "machine", "that reads another machine and an accumulator",
          circuit("  accumulators:\n    store: {at: x, gas_volume: 3, precharge: -5}\n  machines:\n"
                  "    other: {joint: axle, from: x, to: t, displacement: 0.2, setting: \"0.5 + 0.1*sin(axle.angle)\", "
                  "drag: 0.1}\n"
                  "    it: {joint: axle, from: p, to: t, displacement: 0.3, setting: \"0.7 + 0.1*other.torque + "
                  "0.1*other.flow + 0.05*other.power + 0.1*store.fluid_volume\"}\n"),
          {{"joint", "axel", "did you mean"},
           {"from", "nowhere", "no place"},
           {"to", "p", "from one place to another"},
           {"setting", "other.torqe", "did you mean"}})};
  return list;
}

const std::string soft_keys =
    "ambient_pressure: 0, bulk_modulus: 1e5, density: 1e4, viscosity: 30, air_fraction: 0.1, air_exponent: 1.3";

Sample cylinder(const std::string& variant, const std::string& keys, std::vector<BadValue> bad,
                const std::string& hydraulics = "") {
  bad.push_back({"nodes", "[a, a]", "two different nodes"});
  bad.push_back({"stroke", "[2, 1]", "the shortest distance first"});
  Sample sample{Section::elements, "hydraulic_actuator", variant, circuit(hydraulics), std::move(bad)};
  sample.model +=
      "elements:\n  it: {type: hydraulic_actuator, nodes: [a, b], at: [[0.1, 0, 0.2], [0, 0.2, 0.1]], stroke: "
      "[0.5, 2.5], " +
      keys + "}\n";
  sample.has_no_power = true;
  return sample;
}

std::vector<Sample> cylinders() {
  return {
      cylinder(
          "circuit of its own",
          soft_keys +
              ", vapour_pressure: 900, conserves: volume, piston_areas: [1.2, 0.7], dead_volumes: [3, 4], pressures: "
              "[1.1, 0.9], leakage: 0.1, external_leakage: [0.1, 0.2], compliances: [1e-5, 0], friction: {viscous: "
              "0.3, "
              "coulomb: 0.4, static: 0.6, stribeck_velocity: 0.8, velocity: 0.5}, end_stops: {stiffness: 20, damping: "
              "3}, "
              "supply: {pressure: 3, tank: 1}, valve: {area: 0.1, coefficient: 0.6, density: 800, command: 0.5, "
              "overlap: 0.1, time_constant: 0.1, transition_pressure: 3}, relief: {pressure: 1, area: 0.2}, "
              "accumulator: "
              "{gas_volume: 1, precharge: 1, exponent: 1.2}, cushions: {lengths: [0.1, 0.1], areas: [0.01, 0.02], "
              "port_area: 0.1}",
          {{"pressures", "[-2e5, 0]", "vacuum"},
           {"friction.static", "0.1", "no less than"},
           {"friction.stribeck_velocity", "", "needs a `stribeck_velocity`"},
           {"supply.pressure", "", "one of the two"},
           {"supply.tank", "no", ""},
           {"valve.area", "", "needs an `area`"},
           {"relief.area", "", "needs an `area`"},
           {"accumulator.precharge", "-2e5", "vacuum"},
           {"cushions.lengths", "[3, 1]", "longer than the stroke"},
           {"cushions.areas", "[1, 1]", "smaller than"}}),
      cylinder("with cushions, in a circuit",
               "piston_areas: [1.2, 0.7], dead_volumes: [3, 4], ports: [p, t], pressures: [1.1, 0.9], compliances: "
               "[1e-5, 0], cushions: {lengths: [0.1, 0.1], areas: [0.01, 0.02], port_area: 0.1}",
               {{"ports", "[p, p]", "the same place"},
                {"pressures", "[-2e5, 0]", "vacuum"},
                {"cushions.lengths", "[3, 1]", "longer than the stroke"},
                {"cushions.areas", "[1, 1]", "smaller than"}}),
      cylinder("telescopic, in a circuit",
               "stages: [{piston_areas: [1.5, 0.4], length: 0.8}, {piston_areas: [0.9, 0.2], length: 1.2}], "
               "dead_volumes: [2, "
               "3], ports: [p, t]",
               {{"stages", "[{piston_areas: [1, 1], length: 1}]", "m long together"}, {"ports", "[p]", "two places"}}),
      cylinder("single-acting, against a given pressure",
               "piston_areas: [1.5, 0.5], dead_volumes: [2, 0], ports: [p, tank]",
               {{"ports", "[p, p]", "the same place"}}, "  supplies: {tank: {pressure: 0}}\n")};
}

/// The measures of a cylinder with friction: a spring between its nodes uses them.
Sample measured_cylinder() {
  Sample sample{Section::elements,
                "spring_damper",
                "measures of a cylinder",
                circuit(""),
                {{"force", "jack.forc", "did you mean 'force'"}}};
  sample.model +=
      "elements:\n  jack: {type: hydraulic_actuator, nodes: [a, b], at: [[0.1, 0, 0.2], [0, 0.2, 0.1]], stroke: [0.5, "
      "2.5], piston_areas: [1.2, 0.7], dead_volumes: [3, 4], ports: [p, t], friction: {viscous: 0.3, coulomb: 0.4, "
      "velocity: 0.5}}\n"
      "  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0.1, 0.3, 0.2]], force: \"0.5*jack.force + "
      "0.3*jack.length^2 - 0.2*jack.length.rate + 0.1*jack.pressure_2\"}\n";
  return sample;
}

}  // namespace

std::vector<Sample> hydraulic_samples() {
  std::vector<Sample> list = lines();
  for (const Sample& sample :
       {servo_valve(
            "first order",
            law + ", areas: [0.3, 0.4, 0.5, 0.6], overlap: 0.17, command: \"0.3*axle.angle\", time_constant: 0.3, "
                  "transition_pressure: 1",
            within("servo_valve", {})),
        servo_valve("without dynamics",
                    "area: 0.4, command: \"0.5 + 0.4*sin(axle.angle.rate)\", transition_pressure: 1",
                    {{"servo_valve.area", "", "needs an `area`"}})})
    list.push_back(sample);
  for (const auto& more : {places, cylinders})
    for (Sample& sample : more()) list.push_back(std::move(sample));
  list.push_back(measured_cylinder());
  return list;
}

}  // namespace bielle::laws
