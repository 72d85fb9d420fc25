// Lines, valves, accumulators, pipes and machines against closed forms.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/hydraulics/lines/pipe_segment.hpp"
#include "reduce/common/error.hpp"
#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace test_lines {
namespace {

std::string hydraulics(const std::string& text, const std::string& rest = "") {
  return rest + "hydraulics:\n  ambient_pressure: 0\n  fluid: {bulk_modulus: 1.4e9, density: 850, viscosity: 0.04}\n" +
         text;
}

/// Returns the flow of one line between two given pressures.
double steady_flow(const std::string& line, double p_a, double p_b, double t = 1) {
  return at_end(
      hydraulics(fmt::format("  supplies: {{a: {{pressure: {}}}, b: {{pressure: {}}}, x: {{pressure: 2e6}}}}\n"
                             "  lines:\n    it: {{from: a, to: b, {}}}\n",
                             p_a, p_b, line)),
      {.h = t / 10, .end = t}, {"hydraulics/it/flow"})[0];
}

constexpr double area = 1e-5, coefficient = 0.7, rho = 850;
double turbulent(double share, double D) { return coefficient * share * area * std::sqrt(2 * D / rho); }

}  // namespace

TEST_CASE("valves pass what the orifice formula says of their opening") {
  // The difference is far above the laminar range, which changes the flow by (D_t/D)^2/4 at most.
  CHECK(steady_flow("orifice: {area: 1e-5, transition_pressure: 10}", 5e6, 1e6) ==
        Approx(turbulent(1, 4e6)).epsilon(1e-9));
  CHECK(steady_flow("orifice: {area: 1e-5, transition_pressure: 10}", 1e6, 5e6) ==
        Approx(-turbulent(1, 4e6)).epsilon(1e-9));
  CHECK(steady_flow("valve: {area: 1e-5, command: 0.4, transition_pressure: 10}", 5e6, 1e6) ==
        Approx(turbulent(0.4, 4e6)).epsilon(1e-9));
  CHECK(steady_flow("valve: {area: 1e-5, command: 0.4, overlap: 0.1, transition_pressure: 10}", 5e6, 1e6) ==
        Approx(turbulent(0.3 / 0.9, 4e6)).epsilon(1e-9));
  CHECK(steady_flow("valve: {area: 1e-5, command: 0.05, overlap: 0.1}", 5e6, 1e6) == 0);
  CHECK(steady_flow("check: {area: 1e-5, transition_pressure: 10}", 5e6, 1e6) ==
        Approx(turbulent(1, 4e6)).epsilon(1e-9));
  CHECK(steady_flow("check: {area: 1e-5}", 1e6, 5e6) == 0);
  CHECK(steady_flow("relief: {area: 1e-5, pressure: 5e6}", 5.9e6, 1e6) == 0);
  CHECK(steady_flow("relief: {area: 1e-5, pressure: 5e6, transition_pressure: 10}", 6.6e6, 1e6) ==
        Approx(turbulent(1, 5.6e6)).epsilon(1e-9));
  // In the middle of its range above the setting the valve is half open: 10/8 - 15/16 + 6/32.
  CHECK(steady_flow("relief: {area: 1e-5, pressure: 4e6, range: 2e6, vented: true, transition_pressure: 10}", 5e6,
                    1e6) == Approx(turbulent(0.5, 4e6)).epsilon(1e-9));
  // 3 times the pilot's 2 MPa and the load's 5 MPa are the middle of the range from 10 to 12 MPa; in the other
  // direction it is a check valve.
  const std::string counterbalance =
      "counterbalance: {area: 1e-5, pressure: 10e6, range: 2e6, pilot: x, pilot_ratio: 3, transition_pressure: 10}";
  CHECK(steady_flow(counterbalance, 5e6, 1e6) == Approx(turbulent(0.5, 4e6)).epsilon(1e-9));
  CHECK(steady_flow(counterbalance, 3e6, 1e6) == 0);
  CHECK(steady_flow(counterbalance, 1e6, 3e6) == Approx(-turbulent(1, 2e6)).epsilon(1e-9));
  // A flow valve keeps its flow above its pressure difference: D_e = D/(1 + (D/D_min)^8)^(1/8).
  CHECK(steady_flow("flow_valve: {flow: 2e-4, pressure: 1e6}", 8e6, 1e6) == Approx(2e-4).epsilon(1e-4));
  CHECK(steady_flow("flow_valve: {flow: 2e-4, pressure: 1e6}", 1.25e6, 1e6) == Approx(1e-4).epsilon(1e-3));
  CHECK(steady_flow("flow_valve: {flow: 2e-4, pressure: 1e6}", 1e6, 2e6) == Approx(-2e-4).epsilon(1e-4));
  // Hagen and Poiseuille.
  CHECK(steady_flow("laminar: {length: 2, diameter: 0.004}", 2e6, 1e6) ==
        Approx(M_PI * std::pow(0.004, 4) / (128 * 0.04 * 2) * 1e6).epsilon(1e-12));
}

TEST_CASE("an orifice is laminar at small differences, with the slope of its Reynolds number") {
  // Q = 2 C_d^2 A D_h/(rho nu Re_t) D
  const double D_h = std::sqrt(4 * area / M_PI), slope = 2 * 0.49 * area * D_h / (0.04 * 150);
  CHECK(steady_flow("orifice: {area: 1e-5}", 1e6 + 1, 1e6) == Approx(slope).epsilon(1e-6));
}

TEST_CASE("spools follow their command as equations of first and second order") {
  const auto opening = [](const std::string& dynamics) {
    return at_end(hydraulics("  supplies: {a: {pressure: 1e6}, b: {pressure: 0}}\n  lines:\n    it: {from: a, to: b, "
                             "valve: {area: 1e-6, command: \"if(t > 0, 0.5, 0)\", " +
                             dynamics + "}}\n"),
                  {.h = 1e-4, .end = 0.02}, {"hydraulics/it/opening"})[0];
  };
  CHECK(opening("time_constant: 0.01") == Approx(0.5 * -std::expm1(-2.)).epsilon(1e-5));
  const double w = 2 * M_PI * 30, zeta = 0.4, w_d = w * std::sqrt(1 - zeta * zeta), t = 0.02;
  const double exact = 0.5 * (1 - std::exp(-zeta * w * t) * (std::cos(w_d * t) + zeta * w / w_d * std::sin(w_d * t)));
  CHECK(opening("frequency: 30, damping: 0.4") == Approx(exact).epsilon(1e-4));
}

TEST_CASE("a command beyond the ends of a spool ends the run with a sentence") {
  const std::string beyond = hydraulics(
      "  supplies: {a: {pressure: 1e6}, b: {pressure: 0}}\n  lines:\n    it: {from: a, to: b, valve: {area: "
      "1e-6, command: \"1.5*t\"}}\n");
  CHECK_THAT(message_of<bielle::ComputationError>([&] { run_hydraulics(beyond, {.h = 0.1, .end = 1}); }),
             Contains("the command of valve 'it' is 1.05") && Contains("max(0, min(1, ..))"));
}

TEST_CASE("an accumulator takes what its gas gives way: p V^n stays") {
  // 0.1 l are pumped into a volume whose oil is stiff: V_g = V_0 (p_0/p)^(1/n), pressures absolute.
  const std::string filled =
      "hydraulics:\n  fluid: {bulk_modulus: 1e10}\n  volumes: {v: {volume: 1e-6, pressure: 5e6}}\n"
      "  supplies: {pump: {to: v, flow: 1e-4}}\n"
      "  accumulators: {store: {at: v, gas_volume: 1e-3, precharge: 4e6, exponent: 1.4}}\n";
  const std::vector<double> found =
      at_end(filled, {.h = 0.01, .end = 1}, {"hydraulics/v/pressure", "hydraulics/store/fluid_volume"});
  const double V_1 = 1e-3 * std::pow(4. / 5, 1 / 1.4), p = 5e6 * std::pow(V_1 / (V_1 - 1e-4), 1.4);
  CHECK(found[0] == Approx(p).epsilon(1e-3));  // the oil of 0.5 l at B = 1e10 is compressed as well
  CHECK(found[1] == Approx(1e-3 - V_1 + 1e-4).epsilon(1e-3));
}

TEST_CASE("a junction without volume divides the pressure as orifices in series do") {
  const std::vector<double> found = at_end(
      hydraulics("  junctions: [middle]\n  supplies: {a: {pressure: 5e6}, b: {pressure: 0}}\n  lines:\n    first: "
                 "{from: a, to: middle, orifice: {area: 1e-5, transition_pressure: 1}}\n    second: {from: middle, "
                 "to: b, orifice: {area: 2e-5, transition_pressure: 1}}\n"),
      {.h = 0.1, .end = 0.3}, {"hydraulics/middle/pressure", "hydraulics/first/flow", "hydraulics/b/flow"});
  CHECK(found[0] == Approx(1e6).epsilon(1e-9));  // A_1^2 (5 - p) = A_2^2 p
  CHECK(found[1] == Approx(found[2]).epsilon(1e-12));
}

// -- pipes

TEST_CASE("water hammer: the pressure rises by rho a w, and stays for twice the way") {
  // Water in 10 m of steel pipe with a flexible wall: a = sqrt((B/rho)/(1 + B d/(E s))) (Joukowsky; Korteweg for the
  // wall).
  constexpr double L = 10, d = 0.02, s = 0.002, E = 2e11, B = 2.2e9, w = 0.5, p_0 = 2e6;
  const double a = std::sqrt(B / 1000 / (1 + B * d / (E * s))), S = M_PI * d * d / 4, rise = 1000 * a * w;
  const std::string hammer = fmt::format(
      "hydraulics:\n  ambient_pressure: 0\n  fluid: {{bulk_modulus: {}, density: 1000, viscosity: 1e-6}}\n"
      "  junctions: [end]\n  supplies: {{reservoir: {{pressure: {}}}, out: {{to: end, flow: \"-{:.17g}*step(t, 0, 0.2) "
      "+ "
      "{:.17g}*step(t, 0.3, 0.3005)\"}}}}\n"
      "  lines: {{main: {{from: reservoir, to: end, pipe: {{length: {}, diameter: {}, cells: 200, pressure: {}, wall: "
      "{{thickness: {}, young: {}}}}}}}}}\n",
      B, p_0, w * S, w * S, L, d, p_0, s, E);
  double highest = 0, plateau = 0;
  long count = 0;
  run_hydraulics(hammer, {.h = 5e-5, .end = 0.3 + 2.5 * L / a, .rho = 0.6}, [&](const Session& session) {
    const double t = session.time() - 0.3005, p = session.read("hydraulics/end/pressure")[0] - p_0;
    highest = std::max(highest, p);
    if (t > 0.3 * L / a && t < 1.8 * L / a) {
      plateau += p;
      ++count;
    }
  });
  // At a viscosity of 1e-6 friction is far below 1e-3 of the pressure.
  CHECK(plateau / static_cast<double>(count) == Approx(rise).epsilon(2e-3));
  CHECK(highest < 1.05 * rise);
}

TEST_CASE("the loss of a pipe: laminar, rough and turbulent") {
  constexpr double d = 0.02, S = M_PI * d * d / 4, nu = 1e-6;
  const auto factor = [&](double Re, double roughness) {
    const double w = Re * nu / d;
    return pipe_loss({1, d, roughness * d}, 1000, 1000 * nu, w * S).R / (1 / d * 500 * w * w);
  };
  CHECK(factor(500, 0) == Approx(64. / 500).epsilon(1e-6));
  // The law of Hagen and Poiseuille holds down to zero flow, where Churchill's formula is not evaluated: R = 128 mu
  // L/(pi d^4) q.
  for (const double Re : {1e-3, 0.5, 0.999, 1.001, 20.}) CHECK(factor(Re, 0.001) == Approx(64 / Re).epsilon(1e-6));
  const double resistance = 128 * 1000 * nu / (M_PI * std::pow(d, 4));
  CHECK(pipe_loss({1, d, 1e-5}, 1000, 1000 * nu, 0).R_q == Approx(resistance).epsilon(1e-12));
  // Colebrook's equation is solved by iteration; Churchill's fit agrees within half a per cent (his paper), 1 % with
  // the error of Colebrook's equation.
  const auto colebrook = [](double Re, double k) {
    double x = 8;
    for (int i = 0; i < 100; ++i) x = -2 * std::log10(k / 3.7 + 2.51 * x / Re);
    return 1 / (x * x);
  };
  for (const auto& [Re, k] : {std::pair{1e5, 1e-4}, {1e6, 1e-3}, {1e7, 1e-5}})
    CHECK(factor(Re, k) == Approx(colebrook(Re, k)).epsilon(0.015));
  for (const double q : {1e-9, 1e-5, -3e-5, 5e-5, 1e-3}) {
    const PipeData pipe{1, d, 1e-5};
    const double e = 1e-5 * std::abs(q);
    CHECK((pipe_loss(pipe, 1000, 1e-3, q + e).R - pipe_loss(pipe, 1000, 1e-3, q - e).R) / (2 * e) ==
          Approx(pipe_loss(pipe, 1000, 1e-3, q).R_q).epsilon(1e-5));
  }
}

// -- machines

TEST_CASE("a pump drives a motor: speeds are those of the displacements, and nothing is lost between them") {
  // The pump is turned at 50 rad/s; the motor, of twice the displacement, winds up a flywheel against a brake of 2 N m.
  const std::string transmission = hydraulics(
      "  volumes: {high: {volume: 1e-4, pressure: 1e6}, low: {volume: 1e-4, pressure: 1e6}}\n"
      "  machines:\n    pump: {joint: input, from: low, to: high, displacement: 2e-6}\n"
      "    motor: {joint: output, from: high, to: low, displacement: 4e-6, leakage: 1e-13, drag: 0.01}\n",
      "nodes: {shaft: {}, wheel: {}}\nelements:\n  shaft: {type: rigid_body, node: shaft, mass: 1, inertia: [1, 1, "
      "0.1]}\n"
      "  wheel: {type: rigid_body, node: wheel, mass: 1, inertia: [1, 1, 0.01]}\n"
      "joints:\n  input: {type: hinge, nodes: [ground, shaft], axis: [0, 0, 1]}\n"
      "  output: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1], damping: 0.08}\n"
      "drives: {turn: {joint: input, angle: \"25*t^2*if(t < 1, 1, 0) + (25 + 50*(t - 1))*if(t < 1, 0, 1)\"}}\n");
  const std::vector<double> found =
      at_end(transmission, {.h = 2e-3, .end = 4},
             {"joints/output/rate", "hydraulics/high/pressure", "hydraulics/low/pressure", "hydraulics/pump/power",
              "hydraulics/motor/power", "hydraulics/motor/torque"});
  const double rate = found[0], D = found[1] - found[2], leak = 1e-13 * D;
  CHECK(rate == Approx((2e-6 * 50 - leak) / 4e-6).epsilon(1e-6));
  CHECK(found[5] == Approx(0.08 * rate).epsilon(1e-6));
  CHECK(found[4] == Approx(0.08 * rate * rate).epsilon(1e-6));
  // The power of the pump is that of the motor, of its drag and of its leakage.
  CHECK(-found[3] == Approx(found[4] + 0.01 * rate * rate + leak * D).epsilon(1e-3));
}

}  // namespace test_lines
