// A value of 0 of some keys removes a part: a circuit whose parameter is reduced to 0 equals the circuit without the
// part.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

double flow_through(const std::string& line) {
  return at_end(fmt::format("hydraulics:\n  supplies: {{a: {{pressure: 5e6}}, b: {{pressure: 1e6}}, x: {{pressure: "
                            "2e6}}}}\n  lines: {{it: {{from: a, to: b, {}}}}}\n",
                            line),
                {.h = 1e-2, .end = 3e-2}, {"hydraulics/it/flow"})[0];
}

}  // namespace

TEST_CASE("lines: no area, no coefficient, no conductance let nothing through") {
  for (const char* line :
       {"orifice: {area: 0}", "orifice: {diameter: 0}", "orifice: {area: 1e-5, coefficient: 0}",
        "orifice: {area: 1e-5, coefficient: 0, transition_pressure: 100}", "laminar: {conductance: 0}",
        "laminar: {length: 1, diameter: 0}", "check: {area: 0}", "relief: {pressure: 1e6, diameter: 0}",
        "counterbalance: {pressure: 1e6, pilot: x, pilot_ratio: 3, area: 0}", "valve: {area: 0, command: 1}"}) {
    CAPTURE(line);
    CHECK(flow_through(line) == 0);
  }
}

TEST_CASE("lines: no time constant, no setting and no pilot are as if the key were not there") {
  const auto same = [](const std::string& one, const std::string& other) {
    CAPTURE(one);
    const double flow = flow_through(one);
    CHECK(flow > 0);
    CHECK(flow == Approx(flow_through(other)).epsilon(1e-12));
  };
  same("check: {area: 1e-5, time_constant: 0}", "check: {area: 1e-5}");
  same("relief: {pressure: 2e6, area: 1e-5, time_constant: 0}", "relief: {pressure: 2e6, area: 1e-5}");
  same("relief: {pressure: 0, area: 1e-5}", "check: {area: 1e-5}");
  same("valve: {area: 1e-5, command: 0.4, time_constant: 0}", "valve: {area: 1e-5, command: 0.4}");
  // Only the pressure of its load opens the valve, which is a relief valve whose spring room is vented.
  same("counterbalance: {pressure: 3e6, pilot: x, pilot_ratio: 0, area: 1e-5}",
       "relief: {pressure: 3e6, vented: true, area: 1e-5}");
}

TEST_CASE("an accumulator without gas and a machine without displacement do nothing") {
  const auto pressure = [](const std::string& more) {
    return at_end(
        "nodes: {wheel: {angular_velocity: [0, 0, 50]}}\nelements: {wheel: {type: rigid_body, node: wheel, mass: "
        "1, inertia: [1, 1, 1]}}\njoints: {axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}}\n"
        "hydraulics:\n  volumes: {v: {volume: 1e-4, pressure: 5e6}}\n  supplies: {pump: {to: v, flow: 1e-6}, "
        "tank: {pressure: 101325}}\n" +
            more,
        {.h = 1e-3, .end = 1e-2}, {"hydraulics/v/pressure"})[0];
  };
  const double alone = pressure("");
  CHECK(pressure("  accumulators: {s: {at: v, gas_volume: 0, precharge: 2e6}}\n") == Approx(alone).epsilon(1e-9));
  CHECK(pressure("  machines: {m: {joint: axle, from: v, to: tank, displacement: 0}}\n") ==
        Approx(alone).epsilon(1e-9));
}

TEST_CASE("a cylinder without friction, stops and cushions, by keys of 0") {
  const auto length = [](const std::string& more) {
    return at_end(
        "gravity: [0, 0, -9.81]\nnodes: {mass: {position: [0, 0, 1.2], fixed: [x, y, rx, ry, rz]}}\nelements:\n"
        "  load: {type: point_mass, node: mass, mass: 500}\n  jack: {type: hydraulic_actuator, nodes: [ground, "
        "mass], piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-4, 1e-4], stroke: [1, 1.5], supply: {pressure: "
        "1e7}, valve: {area: 1e-6, command: 0.5}" +
            more + "}\n",
        {.h = 1e-3, .end = 0.05}, {"elements/jack/length"})[0];
  };
  const double plain = length("");
  CHECK(plain > 1.2001);
  CHECK(length(", end_stops: {stiffness: 0}") == Approx(plain).epsilon(1e-9));
  CHECK(length(", friction: {viscous: 0, coulomb: 0, static: 0, stribeck_velocity: 0}") == Approx(plain).epsilon(1e-9));
  CHECK(length(", leakage: 0, external_leakage: [0, 0], compliances: [0, 0]") == Approx(plain).epsilon(1e-9));
  CHECK(length(", vapour_pressure: 0") == Approx(plain).epsilon(1e-9));
  // A cushion of zero length is the port alone, and one that closes completely closes at the end only.
  const std::string port = ", cushions: {lengths: [0, 0], areas: [1e-7, 1e-7], port_area: 1e-4}",
                    far = ", cushions: {lengths: [1e-3, 1e-3], areas: [0, 0], port_area: 1e-4}";
  CHECK(length(port) == Approx(plain).epsilon(1e-4));
  CHECK(length(far) == Approx(length(port)).epsilon(1e-12));
}
