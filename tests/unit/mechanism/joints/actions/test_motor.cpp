// Direct-current motors against closed forms, and their account of energy.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/support/hinged_rotor.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::rotor;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_motor {

/// R 2 Ohm, L 0.1 H, k 0.4 N m/A at 12 V on a rotor of 0.5 kg m^2, unless other keys are given.
constexpr double R = 2, L = 0.1, k = 0.4, V = 12, J = 0.5;

std::string at_voltage(const std::string& voltage, const std::string& more = "inductance: 0.1") {
  return rotor("drives: {m: {joint: main, motor: {voltage: \"" + voltage + "\", resistance: 2, torque_constant: 0.4, " +
               more + "}}}\nmeasures: {w: main.angle.rate}\n");
}

double measured(Session& session, const std::string& name) { return session.read("measures/" + name)[0]; }

}  // namespace test_motor
using namespace test_motor;

TEST_CASE("a motor answers a voltage as the closed form of second order, with current, torque and power") {
  // L i' + R i + k w = V, J w' = k i from rest: w = V/k (1 + (p2 e^(p1 t) - p1 e^(p2 t))/(p1 - p2)).
  const double half = R / (2 * L), root = std::sqrt(half * half - k * k / (L * J)), p1 = -half + root,
               p2 = -half - root;
  const double t = 0.3;
  const double w = V / k * (1 + (p2 * std::exp(p1 * t) - p1 * std::exp(p2 * t)) / (p1 - p2));
  const double i = J / k * V / k * p1 * p2 * (std::exp(p1 * t) - std::exp(p2 * t)) / (p1 - p2);
  check_second_order(
      [&](double h) {
        Session session = session_of(at_voltage("12"));
        Motion motion = session.dynamics(steps_of(t, h));
        motion.finish();
        CHECK(measured(session, "m.torque") == Approx(k * measured(session, "m.current")).epsilon(1e-14));
        CHECK(measured(session, "m.power") == Approx(V * measured(session, "m.current")).epsilon(1e-14));
        CHECK(session.read("joints/main/drive_force")[0] == Approx(measured(session, "m.torque")).epsilon(1e-14));
        return Eigen::Vector2d(measured(session, "w") - w, measured(session, "m.current") - i);
      },
      0.01, 3);
}

TEST_CASE("a motor without inductance has the current of Ohm's law") {
  // J w' = k (V - k w)/R
  const double t = 0.8, w = V / k * (1 - std::exp(-k * k / (J * R) * t));
  check_second_order(
      [&](double h) {
        Session session = session_of(at_voltage("12", "inductance: 0"));
        Motion motion = session.dynamics(steps_of(t, h));
        CHECK(measured(session, "m.current") == Approx(V / R).epsilon(1e-12));  // at rest
        motion.finish();
        const double speed = measured(session, "w");
        CHECK(measured(session, "m.current") == Approx((V - k * speed) / R).epsilon(1e-10));
        return Eigen::VectorXd::Constant(1, speed - w);
      },
      0.1, 3);
}

TEST_CASE("no-load speed and stall: friction, a gear and another back EMF included") {
  // R i + n ke w = V, n k i = n^2 b w
  const double n = 3, b = 0.01, ke = 0.35, w = V / (n * ke + R * n * b / k);
  Session session = session_of(at_voltage("12", "inductance: 0.01, gear_ratio: 3, friction: 0.01, back_emf: 0.35"));
  session.dynamics(steps_of(60, 0.05)).finish();
  CHECK(measured(session, "w") == Approx(w).epsilon(1e-9));
  CHECK(measured(session, "m.current") == Approx(n * b * w / k).epsilon(1e-9));
  // The motor is stalled against a spring: the torque is n k V/R.
  Session stalled = session_of(
      "nodes: {rotor: {position: [0, 0, 0]}}\n"
      "elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}\n"
      "joints: {main: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1], stiffness: 20}}\n"
      "drives: {m: {joint: main, motor: {voltage: 12, resistance: 2, inductance: 0.1, torque_constant: 0.4, "
      "gear_ratio: 3}}}\nmeasures: {turned: main.angle}\n");
  compute_statics(stalled);
  CHECK(measured(stalled, "m.current") == Approx(V / R).epsilon(1e-12));
  CHECK(measured(stalled, "turned") == Approx(3 * k * V / R / 20).epsilon(1e-9));
}

TEST_CASE("the voltage may depend on the motor's own current: a current controller") {
  // L i' = K (5 - i): back EMF compensated.
  Session session = session_of(at_voltage("2*m.current + 0.4*main.angle.rate + 3*(5 - m.current)"));
  session.dynamics(steps_of(2, 0.01)).finish();
  CHECK(measured(session, "m.current") == Approx(5).epsilon(1e-9));
  CHECK_THAT(bielle::test::message_of<InputError>([] { session_of(at_voltage("0.1*m.power")); }),
             Contains("refers back to it"));
}

TEST_CASE("a motor's account of energy is closed with the order of the steps") {
  // Input V i, heat R i^2, magnetic and kinetic energy: the balance is closed.
  const auto missing = [](double h) {
    Session session = session_of(
        at_voltage("12*sin(5*t) - m.current", "inductance: 0.1, back_emf: 0.3, friction: 0.02, gear_ratio: 2"));
    Motion motion = session.dynamics(steps_of(1, h));
    motion.finish();
    CHECK(motion.energy().input > 1);
    CHECK(motion.energy().dissipation > 1);
    return motion.balance();
  };
  check_second_order([&](double h) { return Eigen::VectorXd::Constant(1, missing(h)); }, 0.01, 3, 0.2, 0.3);
}

TEST_CASE("a released motor has no torque and no back EMF") {
  Session session =
      session_of(rotor("drives: {m: {joint: main, release: 0.5, motor: {voltage: 12, resistance: 2, inductance: 0.1, "
                       "torque_constant: 0.4}}}\nmeasures: {w: main.angle.rate}\n"));
  Motion motion = session.dynamics(steps_of(2, 0.01));
  motion.advance_to(0.5);
  const double speed = measured(session, "w");
  CHECK(speed > 1);
  motion.finish();
  CHECK(measured(session, "w") == Approx(speed).epsilon(1e-9));
  CHECK(measured(session, "m.current") == Approx(V / R).epsilon(1e-9));
}

TEST_CASE("a motion with a motor goes on from a save to the last bit") {
  const std::string text = at_voltage("12*sin(5*t) - m.current");
  const DynamicsOptions options = steps_of(1, 0.01);
  Session session = session_of(text);
  Motion motion = session.dynamics(options);
  motion.advance_to(0.5);
  const std::vector<double> saved = session.save();
  motion.finish();
  Session other = session_of(text);
  other.dynamics(options, saved).finish();
  for (const char* name : {"w", "m.current", "m.power"}) CHECK(measured(other, name) == measured(session, name));
}
