// States in motion: closed forms, equivalent forms of the same equations, start values, and continuation of a saved
// state.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/describe_model.hpp"
#include "tests/support/hinged_rotor.hpp"
#include "tests/support/runge_kutta.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::advance_by_runge_kutta;
using bielle::test::check_second_order;
using bielle::test::rotor;
using bielle::test::session_of;
using bielle::test::steps_of;

namespace {

/// Returns the values of measures at the end of a motion.
Eigen::VectorXd at_end(const std::string& text, double duration, double h, const std::vector<std::string>& names,
                       double tolerance = 0) {
  Session session = session_of(text);
  DynamicsOptions options = steps_of(duration, h);
  options.stepping.tolerance = tolerance;
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = session.read("measures/" + names[k])[0];
  return values;
}

}  // namespace

TEST_CASE("a first-order filter answers a ramp and a sine as its closed form") {
  constexpr double T = 0.15, rate = 2, w = 7, end = 0.5;
  const std::string states = "states: {lag: {filter: main.angle, time_constant: 0.15}}\n";
  // The state starts from 1, without a transient of its own.
  check_second_order(
      [&](double h) {
        const double y = at_end(rotor("drives: {m: {joint: main, angle: \"1 + 2*t\"}}\n" + states), end, h, {"lag"})[0];
        return Eigen::VectorXd::Constant(1, y - (1 + rate * (end - T + T * std::exp(-end / T))));
      },
      0.02, 4);
  check_second_order(
      [&](double h) {
        const double y =
            at_end(rotor("drives: {m: {joint: main, angle: \"sin(7*t)\"}}\n" + states), end, h, {"lag"})[0];
        const double exact =
            (std::sin(w * end) - w * T * std::cos(w * end) + w * T * std::exp(-end / T)) / (1 + w * w * T * T);
        return Eigen::VectorXd::Constant(1, y - exact);
      },
      0.02, 4);
}

TEST_CASE("a second-order filter answers a step as its closed form, and has a rate") {
  const double w = 2 * M_PI * 2, d = 0.3, wd = w * std::sqrt(1 - d * d), end = 0.4;
  const double decay = std::exp(-d * w * end);
  const Eigen::Vector2d exact(1 - decay * (std::cos(wd * end) + d * w / wd * std::sin(wd * end)),
                              decay * w * w / wd * std::sin(wd * end));
  check_second_order(
      [&](double h) {
        const Eigen::VectorXd found =
            at_end(rotor("states: {smooth: {filter: 1, frequency: 2, damping: 0.3, start: 0}}\n"
                         "measures: {speed: smooth.rate}\n"),
                   end, h, {"smooth", "speed"});
        return Eigen::Vector2d((found - exact).cwiseQuotient(Eigen::Vector2d(1, w)));
      },
      0.01, 4);
}

TEST_CASE("a transfer function, the same in state space and as two differential equations are one") {
  // (2 s^2 + s + 3)/(s^2 + 4 s + 5):  2 + (-7 s - 7)/(s^2 + 4 s + 5)
  const std::string text = rotor(R"yaml(
drives: {m: {joint: main, angle: "sin(3*t)"}}
states:
  one: {transfer_function: {numerator: [2, 1, 3], denominator: [1, 4, 5]}, input: main.angle}
  two: {state_space: {A: [[0, 1], [-5, -4]], B: [[0], [1]], C: [[-7, -7]], D: [[2]]}, inputs: [main.angle]}
  p: {rate: "r"}
  r: {rate: "-5*p - 4*r + main.angle"}
measures: {three: "-7*p - 7*r + 2*main.angle"}
)yaml");
  Eigen::Vector3d z(0, 0, 0);  // p, r, t
  advance_by_runge_kutta(z, 0.8, 4000, [](const Eigen::Vector3d& at) {
    return Eigen::Vector3d(at[1], -5 * at[0] - 4 * at[1] + std::sin(3 * at[2]), 1);
  });
  const double exact = -7 * z[0] - 7 * z[1] + 2 * std::sin(3 * 0.8);
  check_second_order(
      [&](double h) {
        const Eigen::VectorXd y = at_end(text, 0.8, h, {"one", "two", "three"});
        // The same linear equations in other coordinates, to Newton's tolerance.
        CHECK(y[0] == Approx(y[2]).epsilon(1e-8));
        CHECK(y[1] == Approx(y[2]).epsilon(1e-8));
        return Eigen::VectorXd(y.array() - exact);
      },
      0.02, 4);
}

TEST_CASE("states that depend on each other may stand in any order") {
  const std::string x = "  x: {rate: y, start: 1}\n", y = "  y: {rate: \"-9*x\"}\n",
                    z = "  z: {filter: x, time_constant: 1}\n";
  const std::vector<std::string> names = {"x", "y", "z"};
  const Eigen::VectorXd one = at_end(rotor("states:\n" + x + y + z), 0.7, 0.01, names),
                        other = at_end(rotor("states:\n" + z + y + x), 0.7, 0.01, names);
  CHECK((one - other).norm() < 1e-9);
  check_second_order(
      [&](double h) {
        const Eigen::VectorXd end = at_end(rotor("states:\n" + y + x), 0.7, h, {"x", "y"});
        return Eigen::Vector2d(end[0] - std::cos(3 * 0.7), (end[1] + 3 * std::sin(3 * 0.7)) / 3);
      },
      0.02, 4);
}

TEST_CASE("a motor that follows a filtered angle moves its joint as the equation of third order says") {
  // 0.5 q'' = -50 (s - 1) - 2 q',  T s' = q - s
  const std::string text = rotor(R"yaml(
states: {seen: {filter: main.angle, time_constant: 0.01}}
drives: {motor: {joint: main, torque: "-50*(seen - 1) - 2*main.angle.rate"}}
measures: {turned: main.angle, speed: main.angle.rate}
)yaml");
  Eigen::Vector3d z(0, 0, 0);
  const auto rate = [](const Eigen::Vector3d& at) {
    return Eigen::Vector3d(at[1], (-50 * (at[2] - 1) - 2 * at[1]) / 0.5, (at[0] - at[2]) / 0.01);
  };
  advance_by_runge_kutta(z, 0.6, 20000, rate);
  check_second_order(
      [&](double h) {
        const Eigen::VectorXd end = at_end(text, 0.6, h, {"turned", "speed", "seen"});
        return Eigen::Vector3d(end[0] - z[0], (end[1] - z[1]) / 10, end[2] - z[2]);
      },
      0.005, 4);
  // The steps follow the error; the bound is that of the manual, tolerance^(2/3).
  const Eigen::VectorXd end = at_end(text, 0.6, 1e-4, {"turned", "speed", "seen"}, 1e-8);
  CHECK(std::abs(end[0] - z[0]) < std::pow(1e-8, 2.0 / 3));
  CHECK(std::abs(end[2] - z[2]) < std::pow(1e-8, 2.0 / 3));
}

TEST_CASE("kinks in time of a state's rate end steps") {
  // 4/s up to 0.1234 s, -6/s after it: constant on either side, exact for the scheme that is started anew there.
  for (const double h : {0.05, 0.01}) {
    const Eigen::VectorXd end =
        at_end(rotor("states: {way: {rate: \"if(t < 0.1234, 4, -6)\", start: 0.3}}\n"), 0.5, h, {"way"});
    CHECK(end[0] == Approx(0.3 + 4 * 0.1234 - 6 * (0.5 - 0.1234)).epsilon(1e-11));
  }
}

TEST_CASE("filters begin at their inputs, one behind the other, and go on where an analysis has ended") {
  const std::string text = rotor(R"yaml(
drives: {m: {joint: main, angle: "0.7 + t*t"}}
states:
  third: {filter: second, frequency: 3}
  second: {filter: "2*first", time_constant: 0.2}
  first: {filter: main.angle, time_constant: 0.1}
  lead: {transfer_function: {numerator: [1, 1], denominator: [1, 2]}, input: main.angle, start: equilibrium}
  fresh: {transfer_function: {numerator: [1, 1], denominator: [1, 2]}, input: main.angle}
)yaml");
  Session session = session_of(text);
  const auto value = [&](const char* name) { return session.read(std::string("measures/") + name)[0]; };
  {
    Motion motion = session.dynamics(steps_of(0.3, 0.01));
    CHECK(value("first") == Approx(0.7).epsilon(1e-12));
    CHECK(value("second") == Approx(1.4).epsilon(1e-12));
    CHECK(value("third") == Approx(1.4).epsilon(1e-12));
    CHECK(value("lead") == Approx(0.35).epsilon(1e-12));
    CHECK(value("fresh") == Approx(0.7).epsilon(1e-12));  // its direct feed-through
    motion.finish();
  }
  const double before = value("first");
  CHECK(before < 0.7 + 0.09 - 1e-3);
  Motion motion = session.dynamics(steps_of(0.3, 0.01));
  CHECK(value("first") == before);
}

TEST_CASE("a filter of a reaction begins at the reaction") {
  // The axle carries the weight, 9.81 N on 1 kg, along its x axis.
  const std::string text = R"yaml(
gravity: [-9.81, 0, 0]
nodes: {rotor: {position: [0, 0, 0]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {main: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1], second_axis: [1, 0, 0]}}
states: {load: {filter: main.reaction.x, time_constant: 0.1}}
)yaml";
  Session session = session_of(text);
  session.assemble();  // it knows no reactions
  CHECK(session.read("measures/load")[0] == 0);
  Motion motion = session.dynamics(steps_of(0.1, 0.01));
  CHECK(session.read("measures/load")[0] == Approx(9.81).epsilon(1e-11));
  motion.finish();
  CHECK(session.read("measures/load")[0] == Approx(9.81).epsilon(1e-9));
}

TEST_CASE("a motion with states goes on from a save to the last bit") {
  const std::string text = rotor(R"yaml(
states:
  seen: {filter: main.angle, time_constant: 0.01}
  way: {rate: "seen - 0.1*way", start: 0.2}
  lead: {transfer_function: {numerator: [1, 1], denominator: [1, 2]}, input: seen}
drives: {motor: {joint: main, torque: "-50*(seen - 1) - 2*main.angle.rate - lead + way"}}
)yaml");
  for (const double tolerance : {0.0, 1e-6}) {
    DynamicsOptions options = steps_of(0.4, 0.005);
    options.stepping.tolerance = tolerance;
    Session session = session_of(text);
    Motion motion = session.dynamics(options);
    motion.advance_to(0.2);
    const std::vector<double> saved = session.save();
    motion.finish();
    Session other = session_of(text);
    Motion again = other.dynamics(options, saved);
    again.finish();
    for (const char* name : {"seen", "way", "lead"})
      CHECK(other.read(std::string("measures/") + name) == session.read(std::string("measures/") + name));
    CHECK(other.read("joints/main/coordinate") == session.read("joints/main/coordinate"));
  }
}

TEST_CASE("an event may watch a state") {
  const std::string text = rotor(
      "states: {clock: {rate: 2, start: -1}}\n"
      "events: {noon: {when: clock, crosses: 0.5, action: stop}}\n");
  Session session = session_of(text);
  Motion motion = session.dynamics(steps_of(2, 0.1));
  motion.finish();
  CHECK(motion.time() == Approx(0.75).epsilon(1e-10));
}

TEST_CASE("a check describes states, their starts and units") {
  const MechanismFile file = read_mechanism_text(rotor(R"yaml(
states:
  lag: {filter: main.angle, time_constant: 0.15}
  smooth: {filter: lag, frequency: 3}
  way: {rate: "lag - 0.1*way", start: 0.2, units: m}
  plant: {state_space: {A: [[-1]], B: [[1]]}, inputs: [way]}
)yaml"),
                                                 "model.yaml");
  const std::string said = describe_model(file);
  using Catch::Contains;
  CHECK_THAT(said, Contains("states       4 (filter 2, state 1, state_space 1)"));
  CHECK_THAT(said, Contains("state 'lag' (filter)") && Contains("first-order filter, 0.15 s, of main.angle") &&
                       Contains("starts at its input") && Contains("lag [rad]"));
  CHECK_THAT(said, Contains("smooth.rate [rad/s]"));
  CHECK_THAT(said, Contains("state 'way'") && Contains("rate lag - 0.1*way") && Contains("starts at 0.2") &&
                       Contains("way [m]"));
  CHECK_THAT(said, Contains("state space of order 1 of way"));
}
