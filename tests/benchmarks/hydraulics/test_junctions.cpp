// Junctions whose flows are flat until a valve opens: pressures by the closed form of the valve's law, for all ways in
// which a pressure has to be found, and the messages if there is none.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "reduce/common/error.hpp"
#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using bielle::ComputationError;
using Catch::Contains;

namespace {

constexpr double rho = 850, viscosity = 0.04, discharge = 0.7, tank = 101325, pumped = 1e-4;

/// Returns the flow of an orifice of the area A at the difference D, laminar below a Reynolds number of 150 of a round
/// hole.
double orifice(double A, double D) {
  const double D_h = std::sqrt(4 * A / M_PI), D_t = 0.5 * rho * std::pow(150 * viscosity / rho / (discharge * D_h), 2);
  return discharge * A * std::sqrt(2 / rho) * D / std::pow(D * D + D_t * D_t, 0.25);
}

/// Returns the difference at which a relief valve of 10 mm that opens from 1 to 1.1 MPa passes a flow: by bisection of
/// its law.
double relief(double flow) {
  double low = 1e6, high = 1e7;
  for (int k = 0; k < 100; ++k) {
    const double D = 0.5 * (low + high), x = std::clamp((D - 1e6) / 1e5, 0.0, 1.0);
    const double A = M_PI / 4 * 1e-4 * x * x * x * (10 - x * (15 - 6 * x));
    (x == 0 || orifice(A, D) < flow ? low : high) = D;
  }
  return low;
}

/// Returns the difference at which an orifice passes a flow.
double orifice_drop(double A, double flow) {
  double low = 0, high = 1e9;
  for (int k = 0; k < 200; ++k) (orifice(A, 0.5 * (low + high)) < flow ? low : high) = 0.5 * (low + high);
  return low;
}

std::string circuit(const std::string& places, const std::string& lines, const std::string& flow = "1e-4") {
  return "nodes: {n: {position: [0, 0, 0], fixed: true}}\nhydraulics:\n  fluid: {density: 850, bulk_modulus: 1.4e9}\n "
         " " +
         places + "\n  supplies: {tank: {pressure: 101325}, pump: {flow: \"" + flow + "\", to: j}}\n  lines: {" +
         lines + "}\n";
}

const std::string valve = "c: {from: j, to: tank, relief: {pressure: 1e6, diameter: 0.01}}";

double statics_pressure(const std::string& text, const std::string& place = "j") {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  return session.read("hydraulics/" + place + "/pressure")[0];
}

}  // namespace

TEST_CASE("a pump into a junction that a relief valve drains: the pressure of the valve's law") {
  const double p = tank + relief(pumped);
  CHECK(p == Approx(1.11828e6).epsilon(1e-5));  // the closed form, evaluated apart from this test
  const std::string plain = circuit("junctions: [j]", valve);
  CHECK(statics_pressure(plain) == Approx(p).epsilon(1e-9));
  for (const double tolerance : {0.0, 1e-6}) {
    CAPTURE(tolerance);
    double lowest = 1e9, highest = 0;
    run_hydraulics(plain, {.h = 0.05, .end = 0.2, .tolerance = tolerance}, [&](const Session& session) {
      lowest = std::min(lowest, session.read("hydraulics/j/pressure")[0]);
      highest = std::max(highest, session.read("hydraulics/j/pressure")[0]);
    });
    CHECK(lowest == Approx(p).epsilon(1e-9));
    CHECK(highest == Approx(p).epsilon(1e-9));
    // A volume instead of the junction gives the same result.
    CHECK(at_end(circuit("volumes: {j: {volume: 1e-5}}", valve), {.h = 1e-3, .end = 0.1, .tolerance = tolerance},
                 {"hydraulics/j/pressure"})[0] == Approx(p).epsilon(1e-6));
  }
}

TEST_CASE("a pump that starts in the course of a motion opens the valve within a step") {
  const std::string started = circuit("junctions: [j]", valve, "if(t > 0.101, 1e-4, 0)");
  for (const double tolerance : {0.0, 1e-6})
    run_hydraulics(started, {.h = 0.01, .end = 0.2, .tolerance = tolerance}, [&](const Session& session) {
      const double p = session.read("hydraulics/j/pressure")[0];
      if (session.time() < 0.1) CHECK(p == Approx(tank).epsilon(1e-9));
      if (session.time() > 0.105) CHECK(p == Approx(tank + relief(pumped)).epsilon(1e-9));
    });
}

TEST_CASE("junctions that float together until a valve opens rise together") {
  // Five junctions are in series, and their lines pass the flow at pressure differences far below the valve's setting.
  std::string places = "junctions: [j", lines = "l0: {from: j, to: j1, orifice: {diameter: 0.02}}, ";
  for (int k = 1; k < 5; ++k) {
    places += fmt::format(", j{}", k);
    if (k < 4) lines += fmt::format("l{0}: {{from: j{0}, to: j{1}, orifice: {{diameter: 0.02}}}}, ", k, k + 1);
  }
  const std::string chain =
      circuit(places + "]", lines + "c: {from: j4, to: tank, relief: {pressure: 1e6, diameter: 0.01}}");
  const double drop = orifice_drop(M_PI / 4 * 4e-4, pumped), p = tank + relief(pumped);
  CHECK(statics_pressure(chain, "j4") == Approx(p).epsilon(1e-9));
  CHECK(statics_pressure(chain, "j") - p == Approx(4 * drop).epsilon(1e-3));
  CHECK(at_end(chain, {.h = 0.1, .end = 0.2}, {"hydraulics/j4/pressure"})[0] == Approx(p).epsilon(1e-9));
  // A volume between pump and valve is filled through an orifice; unlike the junction, it begins at the ambient
  // pressure.
  const std::vector<double> filled =
      at_end(circuit("volumes: {store: {volume: 1e-5}}\n  junctions: [j]",
                     valve + ", fill: {from: j, to: store, orifice: {diameter: 0.001}}"),
             {.h = 1e-3, .end = 0.2}, {"hydraulics/j/pressure", "hydraulics/store/pressure"});
  CHECK(filled[0] == Approx(p).epsilon(1e-6));
  CHECK(filled[1] == Approx(p).epsilon(1e-6));
}

TEST_CASE("valves that check, that follow with a time constant, and pumps that draw") {
  // A check valve opens over a range of 0.5 bar, which begins at 0.
  const auto checked = [&](double flow) {
    double low = 0, high = 1e6;
    for (int k = 0; k < 100; ++k) {
      const double D = 0.5 * (low + high), x = std::min(D / 0.5e5, 1.0);
      (orifice(M_PI / 4 * 1e-4 * x * x * x * (10 - x * (15 - 6 * x)), D) < flow ? low : high) = D;
    }
    return low;
  };
  const std::string check = "c: {from: j, to: tank, check: {diameter: 0.01}}";
  CHECK(statics_pressure(circuit("junctions: [j]", check)) == Approx(tank + checked(pumped)).epsilon(1e-9));
  // A check valve opens for the flow that a pump draws.
  const std::string drawn = circuit("junctions: [j]", "c: {from: tank, to: j, check: {diameter: 0.01}}", "-1e-4");
  CHECK(statics_pressure(drawn) == Approx(tank - checked(pumped)).epsilon(1e-9));
  CHECK(at_end(drawn, {.h = 0.1, .end = 0.2}, {"hydraulics/j/pressure"})[0] ==
        Approx(tank - checked(pumped)).epsilon(1e-9));
  // A slow valve begins at the opening that its pressures require.
  const std::string slow =
      circuit("junctions: [j]", "c: {from: j, to: tank, relief: {pressure: 1e6, diameter: 0.01, time_constant: 0.02}}");
  CHECK(statics_pressure(slow) == Approx(tank + relief(pumped)).epsilon(1e-9));
  CHECK(at_end(slow, {.h = 1e-2, .end = 0.1}, {"hydraulics/j/pressure"})[0] ==
        Approx(tank + relief(pumped)).epsilon(1e-6));
}

TEST_CASE("where a junction has no pressure the sentence says whether fluid is pumped in or drawn out") {
  const auto said = [](const std::string& text) {
    return message_of<ComputationError>([&] { run_hydraulics(text, {.h = 0.1, .end = 0.2}); });
  };
  const auto said_at_rest = [](const std::string& text) {
    return message_of<ComputationError>([&] { statics_pressure(text); });
  };
  // A pump works against a check valve, in either direction.
  const std::string in = circuit("junctions: [j]", "c: {from: tank, to: j, check: {diameter: 0.01}}"),
                    out = circuit("junctions: [j]", "c: {from: j, to: tank, check: {diameter: 0.01}}", "-1e-4");
  for (const auto& message : {said(in), said_at_rest(in)})
    CHECK_THAT(message, Contains("junction 'j'") && Contains("more fluid is pumped in") && !Contains("drawn"));
  for (const auto& message : {said(out), said_at_rest(out)})
    CHECK_THAT(message, Contains("junction 'j'") && Contains("more fluid is drawn out") && !Contains("pumped in"));
  // The same situation is reached during a motion.
  const std::string later =
      circuit("junctions: [j]", "c: {from: tank, to: j, check: {diameter: 0.01}}", "if(t > 0.15, 1e-4, 0)");
  CHECK_THAT(said(later), Contains("t = 0.1") && Contains("more fluid is pumped in"));
  // A narrow hole supplies too little flow, down to vacuum.
  const std::string narrow = circuit("junctions: [j]", "c: {from: j, to: tank, orifice: {diameter: 1e-3}}", "-1e-4");
  CHECK_THAT(said(narrow), Contains("down to vacuum") && Contains("drawn out"));
  // Half of the pumped flow leaves, the rest cannot.
  CHECK_THAT(said(circuit("junctions: [j]", "c: {from: j, to: tank, flow_valve: {flow: 5e-5, pressure: 1e5}}")),
             Contains("5e-05 m^3/s are left") && Contains("pumped in"));
}

TEST_CASE("energies that are no numbers fail with the component that has them") {
  // The bulk modulus is given in MPa by mistake: at 20 MPa the fluid is compressed to nothing.
  const std::string soft =
      "nodes: {b: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
      "elements: {b: {type: point_mass, node: b, mass: 100}, j: {type: hydraulic_actuator, nodes: [ground, b], stroke: "
      "[0.8, 1.3], piston_areas: [5e-3, 3e-3], dead_volumes: [1e-4, 1e-4], bulk_modulus: 1400, supply: {pressure: 2e7, "
      "tank: 101325}, valve: {area: 1e-5, command: 0.5}}}\n";
  CHECK_THAT(message_of<ComputationError>([&] { run_hydraulics(soft, {.h = 1e-3, .end = 0.1}); }),
             Contains("t = ") && Contains("of pressure_source 'j.supply' is too large for a number"));
}

TEST_CASE("pressures that seem to be in bar give a warning") {
  const auto warnings = [](const std::string& text) { return read_mechanism_text(text, "model.yaml").warnings; };
  const auto hydraulics = [](const std::string& text) {
    return "nodes: {n: {position: [0, 0, 0], fixed: true}}\nhydraulics:\n" + text;
  };
  const std::vector<std::string> absolute =
      warnings(hydraulics("  supplies: {a: {pressure: 200}}\n  volumes: {v: {volume: 1, pressure: 250}}\n"
                          "  accumulators: {s: {at: v, gas_volume: 1, precharge: 90}}\n"
                          "  lines: {r: {from: v, to: a, relief: {pressure: 210, diameter: 0.01}},\n"
                          "    p: {from: v, to: a, pipe: {length: 1, diameter: 0.01, pressure: 200}}}\n"));
  REQUIRE(absolute.size() == 5);
  const auto has = [&](const std::string& key, const std::string& text) {
    return std::any_of(absolute.begin(), absolute.end(), [&](const std::string& each) {
      return each.find(key) != std::string::npos && each.find(text) != std::string::npos;
    });
  };
  CHECK(has("supplies.a.pressure", "below the vapour pressure, 1000 Pa; 200 bar are 2e+07 Pa"));
  CHECK(has("volumes.v.pressure", "250 bar"));
  CHECK(has("accumulators.s.precharge", "90 bar"));
  CHECK(has("lines.r.relief.pressure", "210 bar"));
  CHECK(has("lines.p.pipe.pressure", "200 bar"));
  // If pressures are relative to the atmosphere, a pressure of 0 is plausible; formulas of t are not checked.
  CHECK(warnings(hydraulics("  ambient_pressure: 0\n  supplies: {a: {pressure: 0}, b: {pressure: 2e7}, c: {pressure: "
                            "\"200*t\"}, d: {pressure: -5e4}}\n"))
            .empty());
  CHECK(warnings(hydraulics("  ambient_pressure: 0\n  supplies: {a: {pressure: 200}}\n")).size() == 1);
  CHECK(warnings(hydraulics("  ambient_pressure: 1\n  supplies: {a: {pressure: 2e7}}\n")).size() == 1);
}
