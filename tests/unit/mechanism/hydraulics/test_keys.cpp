// Values with units in hydraulics: a model with them equals one in SI units, and wrong units are refused.
#include <string>

#include <catch2/catch.hpp>

#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "mechanism/io/describe_model.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using Catch::Contains;

namespace {

/// Returns two nodes, a hinge between them, and three volumes.
std::string circuit(const std::string& entries) {
  return R"yaml(
nodes:
  a: {}
  b: {position: [1, 0, 0]}
joints:
  hold: {type: rigid, nodes: [ground, a]}
  axle: {type: hinge, nodes: [a, b], position: [0, 1, 0], axis: [0, 0, 1]}
elements:
  body: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}
ACTUATOR
hydraulics:
  volumes:
    p: {volume: 1e-3, pressure: 8e6}
    q: {volume: 1e-3, pressure: 2e6}
    r: {volume: 1e-3, pressure: 1e6}
)yaml" + entries;
}

MechanismFile read(std::string text, const std::string& actuator = "") {
  text.replace(text.find("ACTUATOR"), 8, actuator);
  return read_mechanism_text(text, "model.yaml");
}

std::string refusal(const std::string& entries, const std::string& actuator = "") {
  return test::message_of<InputError>([&] { read(circuit(entries), actuator); });
}

std::string line(const std::string& data) { return "  lines: {it: {from: p, to: q, " + data + "}}\n"; }

void check_equal(const std::string& with_units, const std::string& plain) {
  CHECK(describe_model(read(circuit(with_units))) == describe_model(read(circuit(plain))));
}

void check_equal_lines(const std::string& with_units, const std::string& plain) {
  check_equal(line(with_units), line(plain));
}

/// Returns the value of a measure at the start.
double measured(const std::string& entries, const std::string& measure, const std::string& actuator = "") {
  const MechanismFile file = read(circuit(entries), actuator);
  Session session(file.model);
  DynamicsOptions options;
  options.duration = options.stepping.size = 1e-6;
  const Motion motion = session.dynamics(options);
  return session.measure(measure);
}

void check_refused(const std::string& said, const std::string& key, const std::string& unit, const std::string& given) {
  CHECK_THAT(said, Contains("model.yaml:") && Contains(key + ": expected a value in " + unit) &&
                       Contains("found one in '" + given + "'"));
}

}  // namespace

TEST_CASE("a fluid takes values with units") {
  static const KeyTable table{"a fluid", "", fluid_keys()};
  const auto read_text = [](const std::string& text) {
    Fluid fluid;
    read_fluid(YamlValue::parse(text, "model.yaml").keyed(table), fluid);
    return fluid;
  };
  const Fluid fluid = read_text(
      "{density: 0.9 g/cm^3, viscosity: 30 mPa s, bulk_modulus: 1.2 GPa, air_fraction: 0.01, "
      "vapour_pressure: 2 mbar}");
  CHECK(fluid.density == Approx(900));
  CHECK(fluid.viscosity == Approx(0.03));
  CHECK(fluid.bulk_modulus == Approx(1.2e9));
  CHECK(fluid.air_fraction == 0.01);
  CHECK(fluid.vapour_pressure == Approx(200));
}

TEST_CASE("defaults of the table are those of a fluid") {
  static const KeyTable table{"a fluid", "", keys::joined({fluid_keys(), {ambient_pressure_key()}})};
  Fluid fluid;
  fluid.density = fluid.viscosity = fluid.bulk_modulus = fluid.air_exponent = 1;
  fluid.air_fraction = fluid.vapour_pressure = fluid.ambient = 0.1;
  const YamlValue nothing = YamlValue::parse("{}", "model.yaml").keyed(table);
  read_fluid(nothing, fluid);
  read_ambient_pressure(nothing, fluid);
  CHECK(fluid.describe() == Fluid().describe());
  CHECK(fluid.air_exponent == Fluid().air_exponent);
  CHECK(fluid.vapour_pressure == Fluid().vapour_pressure);
}

TEST_CASE("places take values with units") {
  check_equal("    it: {volume: 0.5 L, pressure: 50 bar, compliance: 2 cm^3/MPa}\n",
              "    it: {volume: 0.5e-3, pressure: 5e6, compliance: 2e-12}\n");
  check_refused(refusal("    it: {volume: 2 m^2}\n"), "volumes.it.volume", "m^3", "m^2");
  check_refused(refusal("    it: {volume: 1, pressure: 2 N}\n"), "volumes.it.pressure", "Pa", "N");
  CHECK(measured("  supplies: {tank: {pressure: 1.5 bar}}\n", "tank.pressure") == Approx(1.5e5));
  CHECK(measured("  supplies: {pump: {to: p, flow: 60 L/min}}\n", "pump.flow") == Approx(1e-3));
  check_refused(refusal("  supplies: {pump: {to: p, flow: 60 L}}\n"), "supplies.pump.flow", "m^3/s", "L");
  check_refused(refusal("  ambient_pressure: 1 kg\n"), "hydraulics.ambient_pressure", "Pa", "kg");
}

TEST_CASE("accumulators and machines take values with units") {
  check_equal("  accumulators: {it: {at: p, gas_volume: 2 L, precharge: 60 bar}}\n",
              "  accumulators: {it: {at: p, gas_volume: 2e-3, precharge: 6e6}}\n");
  check_refused(refusal("  accumulators: {it: {at: p, gas_volume: 2 L, precharge: 60 m}}\n"),
                "accumulators.it.precharge", "Pa", "m");
  const std::string machine = "  machines: {it: {joint: axle, from: p, to: q, ";
  check_equal(machine + "displacement: 10 cm^3/rad, leakage: 1 mm^3/(s bar), drag: 3 N mm s/rad}}\n",
              machine + "displacement: 1e-5, leakage: 1e-14, drag: 3e-3}}\n");
  CHECK(measured(machine + "displacement: 10 cm^3/rad, leakage: 1 cm^3/(s bar)}}\n", "it.flow") == Approx(6e-5));
  check_refused(refusal(machine + "displacement: 10 cm^3}}\n"), "machines.it.displacement", "m^3/rad or m^2", "cm^3");
}

TEST_CASE("lines take values with units") {
  check_equal_lines("laminar: {conductance: 2 cm^3/(s bar)}", "laminar: {conductance: 2e-11}");
  check_equal_lines("laminar: {length: 3 m, diameter: 2 mm}", "laminar: {length: 3, diameter: 0.002}");
  check_equal_lines("orifice: {diameter: 2 mm, transition_pressure: 2 bar}",
                    "orifice: {diameter: 0.002, transition_pressure: 2e5}");
  check_equal_lines("check: {area: 3 mm^2, pressure: 0.5 bar, range: 1 bar, time_constant: 5 ms}",
                    "check: {area: 3e-6, pressure: 5e4, range: 1e5, time_constant: 5e-3}");
  check_equal_lines("relief: {area: 3 mm^2, pressure: 50 bar}", "relief: {area: 3e-6, pressure: 5e6}");
  check_equal_lines("counterbalance: {area: 3 mm^2, pressure: 50 bar, pilot: r, pilot_ratio: 3, check_pressure: 2 bar}",
                    "counterbalance: {area: 3e-6, pressure: 5e6, pilot: r, pilot_ratio: 3, check_pressure: 2e5}");
  check_equal_lines("valve: {diameter: 3 mm, command: 0.5, frequency: 60 Hz}",
                    "valve: {diameter: 3e-3, command: 0.5, frequency: 60}");
  check_equal_lines(
      "pipe: {length: 4 m, diameter: 20 mm, roughness: 10 um, pressure: 50 bar, wall: {thickness: 2 mm, "
      "young: 210 GPa}}",
      "pipe: {length: 4, diameter: 0.02, roughness: 1e-5, pressure: 5e6, wall: {thickness: 2e-3, young: 210e9}}");
  CHECK(measured(line("orifice: {area: 3 mm^2}"), "it.flow") == measured(line("orifice: {area: 3e-6}"), "it.flow"));
  CHECK(measured(line("flow_valve: {flow: 6 L/min, pressure: 5 bar}"), "it.flow") ==
        Approx(measured(line("flow_valve: {flow: 1e-4, pressure: 5e5}"), "it.flow")));
  const std::string ports = "  lines: {it: {ports: {P: p, T: q, A: r, B: s}, servo_valve: {command: 0.5, ";
  const std::string place = "    s: {volume: 1e-3}\n";
  check_equal(place + ports + "areas: [1 mm^2, 2 mm^2, 3 mm^2, 4 mm^2]}}}\n",
              place + ports + "areas: [1e-6, 2e-6, 3e-6, 4e-6]}}}\n");
  check_refused(refusal(place + ports + "areas: [1 mm^2, 2 mm^2, 3 mm^2, 4 mm]}}}\n"), "servo_valve.areas[4]", "m^2",
                "mm");
  check_refused(refusal(line("laminar: {conductance: 2 cm^3/s}")), "laminar.conductance", "m^3/(s Pa)", "cm^3/s");
  check_refused(refusal(line("orifice: {area: 3 mm}")), "orifice.area", "m^2", "mm");
  check_refused(refusal(line("check: {area: 3 mm^2, pressure: 3 m}")), "check.pressure", "Pa", "m");
  check_refused(refusal(line("relief: {area: 3 mm^2, pressure: 3 m}")), "relief.pressure", "Pa", "m");
  check_refused(refusal(line("counterbalance: {area: 3 mm^2, pressure: 3 m, pilot: r, pilot_ratio: 3}")),
                "counterbalance.pressure", "Pa", "m");
  check_refused(refusal(line("flow_valve: {flow: 6 L/min, pressure: 5 L}")), "flow_valve.pressure", "Pa", "L");
  check_refused(refusal(line("valve: {diameter: 3 mm^2, command: 0}")), "valve.diameter", "m", "mm^2");
  check_refused(refusal(line("valve: {diameter: 3 mm, command: 0, frequency: 3 rad/s}")), "valve.frequency", "Hz",
                "rad/s");
  check_refused(refusal(line("pipe: {length: 4 s, diameter: 20 mm, pressure: 0}")), "pipe.length", "m", "s");
  CHECK_THAT(refusal(line("valve: {diameter: 3 mm, command: 0.5 m}")), Contains("valve.command: expected a number "
                                                                                "without a unit, found the unit 'm'"));
}

TEST_CASE("a line with four ports has no ends, and no second type") {
  CHECK_THAT(refusal(line("servo_valve: {area: 1e-6, command: 0}")), Contains("lines.it.from: belongs to a line with"));
  CHECK_THAT(refusal(line("servo_valve: {area: 1e-6, command: 0}, orifice: {area: 1e-6}")),
             Contains("this line is a `orifice` already"));
  CHECK_THAT(refusal(line("orifice: {area: 1e-6}, ports: {P: p, T: q, A: r, B: r}")),
             Contains("belongs to a servo_valve"));
  CHECK_THAT(refusal(line("servo_vlave: {area: 1e-6}")), Contains("did you mean 'servo_valve'"));
}

TEST_CASE("actuators take values with units") {
  const auto actuator = [](const std::string& keys) {
    return "  jack: {type: hydraulic_actuator, nodes: [a, b], at: [[0, 0, 0], [0, 0.1, 0]], " + keys + "}\n";
  };
  const auto described = [&](const std::string& keys) { return describe_model(read(circuit(""), actuator(keys))); };
  CHECK(described("stroke: [0.5 m, 150 cm], piston_areas: [20 cm^2, 10 cm^2], dead_volumes: [0.1 L, 0.2 L], "
                  "pressures: [50 bar, 80 bar], leakage: 1 mm^3/(s bar), external_leakage: [2 mm^3/(s bar), 0], "
                  "compliances: [1 cm^3/GPa, 0], friction: {viscous: 5 N s/cm, coulomb: 1 kN, velocity: 2 mm/s}, "
                  "end_stops: {stiffness: 1 kN/mm, damping: 2 kN s/m}, supply: {flow: 1e-4, volume: 1 L, tank: 2e5}, "
                  "valve: {area: 3 mm^2, command: 0.1}, relief: {pressure: 90 bar, diameter: 2 mm}, accumulator: "
                  "{gas_volume: 1 L, precharge: 10 bar}, cushions: {lengths: [2 cm, 3 cm], areas: [1 mm^2, 2 mm^2], "
                  "port_area: 1 cm^2}, viscosity: 30 mPa s") ==
        described("stroke: [0.5, 1.5], piston_areas: [2e-3, 1e-3], dead_volumes: [1e-4, 2e-4], "
                  "pressures: [5e6, 8e6], leakage: 1e-14, external_leakage: [2e-14, 0], "
                  "compliances: [1e-15, 0], friction: {viscous: 500, coulomb: 1000, velocity: 2e-3}, "
                  "end_stops: {stiffness: 1e6, damping: 2e3}, supply: {flow: 1e-4, volume: 1e-3, tank: 2e5}, "
                  "valve: {area: 3e-6, command: 0.1}, relief: {pressure: 9e6, diameter: 2e-3}, accumulator: "
                  "{gas_volume: 1e-3, precharge: 1e6}, cushions: {lengths: [0.02, 0.03], areas: [1e-6, 2e-6], "
                  "port_area: 1e-4}, viscosity: 0.03"));
  CHECK(described("stroke: [0.5, 1.5], stages: [{piston_areas: [20 cm^2, 0 cm^2], length: 1000 mm}], "
                  "dead_volumes: [0.1 L]") ==
        described("stroke: [0.5, 1.5], stages: [{piston_areas: [2e-3], length: 1}], dead_volumes: [1e-4, 0]"));
  CHECK(measured("", "jack.tank.pressure",
                 actuator("stroke: [0.5, 1.5], piston_areas: [2e-3, 1e-3], supply: {pressure: 90 bar, tank: 2 bar}, "
                          "valve: {area: 1e-6, command: 0}")) == Approx(2e5));
  const auto refused = [&](const std::string& keys) { return refusal("", actuator(keys)); };
  check_refused(refused("stroke: [0.5 m, 150 kg], piston_areas: [1, 1]"), "jack.stroke[2]", "m", "kg");
  check_refused(refused("stroke: [0.5, 1.5], piston_areas: [20 cm, 1]"), "jack.piston_areas[1]", "m^2", "cm");
  check_refused(refused("stroke: [0.5, 1.5], piston_areas: [2e-3], dead_volumes: [1 m^2]"), "jack.dead_volumes[1]",
                "m^3", "m^2");
  check_refused(refused("stroke: [0.5, 1.5], piston_areas: [2e-3], end_stops: {stiffness: 3 N}"),
                "jack.end_stops.stiffness", "N/m", "N");
  check_refused(refused("stroke: [0.5, 1.5], piston_areas: [2e-3], friction: {viscous: 3 N}"), "jack.friction.viscous",
                "N s/m", "N");
  CHECK_THAT(refused("stroke: [0.5, 1.5], piston_areas: [2e-3], friction: {coulomb: 1, static: 2, "
                     "stribeck_velocity: 0}"),
             Contains("friction.stribeck_velocity: expected a rate greater than 0"));
}
