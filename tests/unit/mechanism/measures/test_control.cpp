// Formulas of the state at work: controllers written with measures, inputs that a program sets, kinks of formulas.
#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::model_of;
using bielle::test::steps_of;

namespace {

/// Replaces each of the marks by its text.
std::string with(std::string text, const std::vector<std::pair<std::string, std::string>>& marks) {
  for (const auto& [mark, by] : marks)
    for (std::size_t at; (at = text.find(mark)) != std::string::npos;) text.replace(at, mark.size(), by);
  return text;
}

/// x'' + 2 delta x' + omega^2 x = 0
struct Damped {
  double omega, delta, x, v;
  double frequency() const { return std::sqrt(omega * omega - delta * delta); }
  double at(double t) const {
    const double w = frequency();
    return std::exp(-delta * t) * (x * std::cos(w * t) + (v + delta * x) / w * std::sin(w * t));
  }
  double rate(double t) const {
    const double w = frequency(), b = (v + delta * x) / w;
    return std::exp(-delta * t) * ((b * w - delta * x) * std::cos(w * t) - (x * w + delta * b) * std::sin(w * t));
  }
};

/// A rotor of 0.5 kg m^2, a point of it off the axle, held at an angle by a torque of 50 N m/rad and 2 N m s/rad.
const std::string rotor = R"yaml(
nodes: {rotor: {position: [0.4, 0, 0]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.34]}}
joints: {main: {type: hinge, nodes: [ground, rotor], position: [0, 0, 0], axis: [0, 0, 1]}}
inputs: {target: 0.5}
)yaml";
constexpr double omega = 10, delta = 2;  // sqrt(50/0.5), 2/0.5/2

}  // namespace

TEST_CASE("a controller written with measures moves a hinge as its closed form") {
  const std::string controller =
      GENERATE("drives: {motor: {joint: main, torque: \"-50*(main.angle - 0.5) - 2*main.angle.rate\"}}\n",
               "drives: {motor: {joint: main, torque: \"-50*lag - 2*speed\"}}\n"
               "measures: {lag: \"main.angle - target\", speed: main.angle.rate}\n",
               "measures: {both: {formula: \"50*lag + 2*main.angle.rate\", units: N m}, lag: \"main.angle - target\"}\n"
               "loads: {motor: {node: rotor, moment: [0, 0, \"-both\"]}}\n");
  CAPTURE(controller);
  const Damped exact{omega, delta, -0.5, 0};
  check_second_order(
      [&](double h) {
        Session session(model_of(rotor + controller));
        Motion motion = session.dynamics(steps_of(0.8, h));
        REQUIRE(motion.finish());
        return Eigen::Vector2d(session.read("joints/main/coordinate")[0] - 0.5 - exact.at(0.8),
                               (session.read("joints/main/rate")[0] - exact.rate(0.8)) / omega);
      },
      0.01, 4);
}

TEST_CASE("a law may name what is declared after it") {
  // The motor of the first hinge follows the second, which stands below it, and is driven.
  const std::string text = R"yaml(
measures: {lag: "first.angle - second.angle"}
nodes: {a: {position: [0, 0, 0]}, b: {position: [0, 0, 1]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.5, 0.5, 0.5]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.5, 0.5, 0.5]}
joints:
  first: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], stiffness: "50*(q - second.angle)"}
  second: {type: hinge, nodes: [ground, b], axis: [0, 0, 1]}
drives: {turn: {joint: second, angle: "3*t"}}
)yaml";
  // q'' = -100 (q - 3 t): q = 3 t - 0.3 sin 10 t
  check_second_order(
      [&](double h) {
        Session session(model_of(text));
        Motion motion = session.dynamics(steps_of(0.8, h));
        REQUIRE(motion.finish());
        return Eigen::VectorXd::Constant(1, session.read("joints/first/coordinate")[0] - 2.4 + 0.3 * std::sin(8.0));
      },
      0.0025, 4);
}

TEST_CASE("an input that jumps within a motion begins another branch there") {
  const std::string controller =
      "drives: {motor: {joint: main, torque: \"-50*(main.angle - target) - 2*main.angle.rate\"}}\n";
  const Damped first{omega, delta, -0.5, 0};
  const double jump = 0.3;  // [s]; the target goes from 0.5 to -0.2
  const Damped then{omega, delta, first.at(jump) + 0.7, first.rate(jump)};
  check_second_order(
      [&](double h) {
        Session session(model_of(rotor + controller));
        Motion motion = session.dynamics(steps_of(0.8, h));
        REQUIRE(motion.advance_to(jump));
        REQUIRE(motion.time() == Approx(jump).epsilon(1e-12));
        session.set_input("target", -0.2);
        REQUIRE(motion.finish());
        return Eigen::Vector2d(session.read("joints/main/coordinate")[0] + 0.2 - then.at(0.5),
                               (session.read("joints/main/rate")[0] - then.rate(0.5)) / omega);
      },
      0.01, 4);
}

namespace {

const std::string cart = R"yaml(
nodes: {cart: {position: [0, 0, 0]}}
elements: {cart: {type: rigid_body, node: cart, mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: prismatic, nodes: [ground, cart], axis: [1, 0, 0]}}
inputs: {command: {start: 3, units: N}}
loads: {push: {node: cart, force: [command, 0, 0]}}
)yaml";

}  // namespace

TEST_CASE("a command that is held between samples is exact, however often it jumps") {
  // Forces are constant between samples: the scheme is exact for each.
  Session session(model_of(cart));
  Motion motion = session.dynamics(steps_of(1, 0.01));
  double x = 0, v = 0, command = 3;
  for (int k = 0; k < 100; ++k) {
    motion.step();
    x += 0.01 * v + 0.01 * 0.01 / 2 * command / 2;
    v += 0.01 * command / 2;
    CHECK(session.node("cart").x.x() == Approx(x).epsilon(1e-11));
    CHECK(session.node("cart").v.x() == Approx(v).epsilon(1e-11).margin(1e-13));
    command = 5 * std::sin(1.0 * k * k);
    session.set_input("command", command);
  }
  CHECK(std::abs(session.balance()) < 1e-11);
}

TEST_CASE("a smooth command that is set for the end of each step is seen to order 2") {
  // x'' = 3 cos(4 t)/2
  check_second_order(
      [&](double h) {
        Session session(model_of(cart));
        Motion motion = session.dynamics(steps_of(1, h));
        while (!motion.done()) {
          session.set_input("command", 3 * std::cos(4 * (motion.time() + h)), true);
          motion.step();
        }
        return Eigen::Vector2d(session.node("cart").x.x() - 3.0 / 32 * (1 - std::cos(4.0)),
                               session.node("cart").v.x() - 3.0 / 8 * std::sin(4.0));
      },
      0.02, 4);
}

TEST_CASE("a saved motion goes on with the inputs that it had") {
  Session session(model_of(cart));
  Motion motion = session.dynamics(steps_of(1, 0.01));
  motion.advance_to(0.3);
  session.set_input("command", -7);
  const std::vector<double> saved = session.save();
  motion.finish();
  const double x = session.node("cart").x.x(), v = session.node("cart").v.x();
  CHECK(v == Approx(0.3 * 1.5 - 0.7 * 3.5).epsilon(1e-11));
  Session other(model_of(cart));
  Motion on = other.dynamics(steps_of(1, 0.01), saved);
  on.finish();
  CHECK(other.node("cart").x.x() == x);
  CHECK(other.node("cart").v.x() == v);
  CHECK_THAT(bielle::test::message_of<InputError>([&] { session.set_input("comand", 1); }),
             Catch::Contains("did you mean 'command'"));
}

TEST_CASE("formulas' kinks in time end steps, wherever the formula stands") {
  // 4 N up to 0.1234 s, -6 N after it, on 2 kg (or N m on 2 kg m^2): constant on either side, exact for the scheme
  // that is started anew there.
  struct Place {
    const char *joint, *more;
  };
  const Place place =
      GENERATE(Place{"prismatic", "drives: {push: {joint: pair, force: \"if(t < 0.1234, 4, -6)\"}}"},
               Place{"hinge", "drives: {push: {joint: pair, torque: \"if(t < 0.1234, 4, -6)\"}}"},
               Place{"prismatic, stiffness: \"if(t < 0.1234, -4, 6)\"", ""},
               Place{"prismatic, damping: \"if(t < 0.1234, -4, 6)\"", ""},
               Place{"prismatic",
                     "measures: {wanted: \"if(t < 0.1234, 4, -6) + 0*pair.displacement\"}\n"
                     "drives: {push: {joint: pair, force: \"wanted\"}}"},
               Place{"prismatic",
                     "loads: {push: {node: body, force: [0, 0, \"if(t < 0.1234, 4, -6) + 0*pair.displacement\"]}}"});
  CAPTURE(place.joint, place.more);
  const std::string text = with(R"yaml(
nodes: {body: {position: [0, 0, 0]}}
elements: {body: {type: rigid_body, node: body, mass: 2, inertia: [2, 2, 2]}}
joints: {pair: {type: JOINT, nodes: [ground, body], axis: [0, 0, 1]}}
MORE
)yaml",
                                {{"JOINT", place.joint}, {"MORE", place.more}});
  const double h = GENERATE(0.01, 0.05), tolerance = GENERATE(0.0, 1e-6);
  Session session(model_of(text));
  DynamicsOptions options = steps_of(0.5, h);
  options.stepping.tolerance = tolerance;
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  const double s = 0.1234, r = 0.5 - s, v = 2 * s;
  CHECK(session.read("joints/pair/rate")[0] == Approx(v - 3 * r).epsilon(1e-10));
  CHECK(session.read("joints/pair/coordinate")[0] == Approx(s * s + v * r - 1.5 * r * r).epsilon(1e-10));
}

TEST_CASE("the kink of a spring's force between two points ends a step") {
  const std::string text = R"yaml(
nodes: {body: {position: [0, 0, 1], fixed: [rx, ry, rz]}}
elements:
  body: {type: point_mass, node: body, mass: 2}
  spring: {type: spring_damper, nodes: [ground, body], force: "if(t < 0.1234, -4, 6)"}
)yaml";
  Session session(model_of(text));
  Motion motion = session.dynamics(steps_of(0.5, 0.05));
  REQUIRE(motion.finish());
  const double s = 0.1234, r = 0.5 - s, v = 2 * s;
  CHECK(session.node("body").v.z() == Approx(v - 3 * r).epsilon(1e-10));
  CHECK(session.node("body").x.z() == Approx(1 + s * s + v * r - 1.5 * r * r).epsilon(1e-10));
}
