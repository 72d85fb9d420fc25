// A cylinder and a mass against independent solutions of the textbook equations
//     m vdot = A_1 p_1 - A_2 p_2 - c v - F,   V_k pdot_k = B (Q_k -+ A_k v),   Q = C_d A sqrt(2 |D|/rho) sign(D)
// (tests/references/hydraulic_cylinder.py): B = 1.4e9 Pa, rho = 850 kg/m^3, C_d = 0.62, m = 500 kg, pressures relative
// to the atmosphere.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_cylinder {
namespace {

constexpr double m = 500, g = 9.81;

std::vector<double> numbers(const std::string& row, const std::vector<std::string>& names) {
  const ReferenceTable table("hydraulic_cylinder");
  std::vector<double> values;
  for (const std::string& name : names) values.push_back(table(row + "." + name));
  return values;
}

/// Returns the mass along z above the ground. @param actuator  further keys
std::string lift(const std::string& actuator, const std::string& node = "", double gravity = 0) {
  return fmt::format(
      "gravity: [0, 0, {}]\n"
      "nodes:\n  mass: {{position: [0, 0, 1], fixed: [x, y, rx, ry, rz]{}}}\n"
      "elements:\n  load: {{type: point_mass, node: mass, mass: {}}}\n"
      "  jack: {{type: hydraulic_actuator, nodes: [ground, mass], ambient_pressure: 0, bulk_modulus: 1.4e9, {}}}\n",
      -gravity, node, m, actuator);
}

const std::string single_acting = lift(
    fmt::format("piston_areas: [2e-3, 0], dead_volumes: [1e-3, 0], stroke: [1, 1.5], pressures: [{:.17g}], friction: "
                "{{viscous: 2000}}, supply: {{pressure: 10e6, tank: 0}}, valve: {{coefficient: 0.62, density: 850, "
                "diameter: 2e-3, command: 1, transition_pressure: 10}}",
                m* g / 2e-3),
    "", g);

/// The volume of the rod side is given at the start of the piston: 0.8e-3 m^3 less the volume of the stroke ahead.
const std::string double_acting_cylinder =
    "piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-3, 0.2e-3], stroke: [1, 1.5]";

const std::string valve_opens =
    lift(double_acting_cylinder +
         ", pressures: [6e6, 10e6], leakage: 1e-12, friction: {viscous: 1500}, supply: {pressure: 21e6, tank: 0.1e6}, "
         "valve: "
         "{coefficient: 0.62, density: 850, area: 5e-6, command: \"min(t/0.01, 1)\", transition_pressure: 10}");

const std::vector<std::string> quantities = {"elements/jack/length", "elements/jack/rate", "elements/jack/pressure"};

}  // namespace

TEST_CASE("a single-acting cylinder lifts a mass as its equations say") {
  const std::vector<double> exact = numbers("lifted_0.1", {"length", "rate", "pressure"});
  check_second_order(
      [&](double h) {
        const std::vector<double> found = at_end(single_acting, {.h = h, .end = 0.1}, quantities);
        return Eigen::Vector3d((found[0] - exact[0]) / 0.01, (found[1] - exact[1]) / 0.1, (found[2] - exact[2]) / 1e6);
      },
      1e-3, 3);
}

TEST_CASE("a single-acting cylinder comes to the speed of the orifice formula") {
  // A v = K sqrt(p_s - (m g + c v)/A)
  const std::vector<double> found = at_end(single_acting, {.h = 2e-3, .end = 2}, quantities);
  const std::vector<double> exact = numbers("lifted_2", {"length", "rate", "pressure"});
  CHECK(found[0] == Approx(exact[0]).epsilon(2e-5));
  CHECK(found[1] == Approx(exact[1]).epsilon(1e-8));
  CHECK(found[2] == Approx(exact[2]).epsilon(1e-7));
}

TEST_CASE("a double-acting cylinder answers its opening valve as its equations say") {
  // At t = 0.1 the ramp of the command ends at a step. The edges of the valve open smoothly over a thousandth of their
  // opening (lines/spool_valve.hpp).
  const std::vector<double> exact = numbers("opened_0.1", {"length", "rate", "pressure_1", "pressure_2"});
  check_second_order(
      [&](double h) {
        const std::vector<double> found = at_end(valve_opens, {.h = h, .end = 0.1}, quantities);
        return Eigen::Vector4d((found[0] - exact[0]) / 0.01, (found[1] - exact[1]) / 0.1, (found[2] - exact[2]) / 1e6,
                               (found[3] - exact[3]) / 1e6);
      },
      5e-4, 3);
}

TEST_CASE("a double-acting cylinder moves steadily at the speed of its valve and leakage") {
  const std::vector<double> found = at_end(valve_opens, {.h = 1e-3, .end = 1}, quantities);
  const std::vector<double> exact = numbers("opened_1", {"length", "rate", "pressure_1", "pressure_2"});
  CHECK(found[0] == Approx(exact[0]).epsilon(1e-5));
  CHECK(found[1] == Approx(exact[1]).epsilon(1e-7));
  CHECK(found[2] == Approx(exact[2]).epsilon(1e-6));
  CHECK(found[3] == Approx(exact[3]).epsilon(1e-6));
}

TEST_CASE("a moving mass is stopped by its closing valve: peak and swing") {
  // The valve opens within 10 ms and closes from 0.2 to 0.26 s against a tank of 5 MPa, below which p_1 stays positive.
  // Peak of p_2 after 0.2 s, then length, rate and pressures at 0.3 s.
  const std::string stopped =
      lift(double_acting_cylinder +
           ", pressures: [6e6, 10e6], leakage: 1e-12, friction: {viscous: 1500}, supply: {pressure: 21e6, tank: 5e6}, "
           "valve: "
           "{coefficient: 0.62, density: 850, area: 5e-6, command: \"step(t, 0, 0.01) - step(t, 0.2, 0.26)\", "
           "transition_pressure: 1e4}");
  Eigen::VectorXd exact(5);
  const std::vector<double> end = numbers("stopped_0.3", {"length", "rate", "pressure_1", "pressure_2"});
  exact << numbers("stopped", {"peak"})[0], end[0], end[1], end[2], end[3];
  check_second_order(
      [&](double h) {
        double peak = 0;
        Eigen::VectorXd found(5);
        run_hydraulics(stopped, {.h = h, .end = 0.3}, [&](const Session& session) {
          const std::vector<double> p = session.read("elements/jack/pressure");
          if (session.time() >= 0.2) peak = std::max(peak, p[1]);
          found << peak, session.read("elements/jack/length")[0], session.read("elements/jack/rate")[0], p[0], p[1];
        });
        Eigen::VectorXd error = found - exact;
        error.array() /= Eigen::Array<double, 5, 1>(1e7, 0.01, 0.1, 1e7, 1e7);
        return error;
      },
      1e-3, 3, 0.2);
}

TEST_CASE("trapped oil is a spring: period and turning points of a blocked cylinder") {
  // p = p_0 - B ln(V/V_0) gives a potential, hence the turning points and, by quadrature, the period.
  const std::string blocked = lift(double_acting_cylinder + ", pressures: [6e6, 10e6]", ", velocity: [0, 0, 0.1]");
  const std::vector<double> exact = numbers("blocked", {"period", "highest", "lowest"});
  const double period = exact[0], h = period / 800;
  double highest = -1, lowest = 1, before = 0, time_before = 0;
  std::vector<double> turns;
  run_hydraulics(blocked, {.h = h, .end = 2.2 * period, .rho = 1}, [&](const Session& session) {
    const double x = session.read("elements/jack/length")[0] - 1, v = session.read("elements/jack/rate")[0];
    highest = std::max(highest, x);
    lowest = std::min(lowest, x);
    if (before * v < 0) turns.push_back(time_before + (session.time() - time_before) * before / (before - v));
    before = v;
    time_before = session.time();
  });
  REQUIRE(turns.size() >= 4);
  CHECK(turns[2] - turns[0] == Approx(period).epsilon(3e-5));
  CHECK(highest == Approx(exact[1]).epsilon(3e-5));
  CHECK(lowest == Approx(exact[2]).epsilon(3e-5));
}

TEST_CASE("a rigid volume fills through an orifice and through a laminar line by closed forms") {
  // p = p_s - (sqrt(p_s) - B K t/(2 V))^2, half the time to fill; 1 - exp(-t/tau), tau = V/(B G).
  const std::string filling =
      "hydraulics:\n  ambient_pressure: 0\n  fluid: {bulk_modulus: 1.4e9, density: 850}\n"
      "  volumes: {a: {volume: 1e-3, pressure: 0}, b: {volume: 1e-3, pressure: 0}}\n"
      "  supplies: {pump: {pressure: 10e6}}\n"
      "  lines:\n    hole: {from: pump, to: a, orifice: {coefficient: 0.62, diameter: 2e-3, transition_pressure: 1}}\n"
      "    gap: {from: pump, to: b, laminar: {conductance: 1e-11}}\n";
  constexpr double full = .047813976397, tau = .0714285714285714;
  const std::vector<double> found =
      at_end(filling, {.h = full / 400, .end = full / 2, .rho = 1}, {"hydraulics/a/pressure", "hydraulics/b/pressure"});
  CHECK(found[0] == Approx(7.5e6).epsilon(1e-5));
  CHECK(found[1] == Approx(10e6 * -std::expm1(-full / 2 / tau)).epsilon(1e-5));
}

}  // namespace test_cylinder
