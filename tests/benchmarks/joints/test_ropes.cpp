// Belts and cables: rates and tensions of belt drives, hoists, tackles, slack ropes, against closed forms.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/second_order.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;

namespace {

/// Returns two pulleys of 0.1 m and 0.2 m, 0.5 m apart, hinged about z.
std::string belt_drive(const std::string& radii, const std::string& more) {
  return fmt::format(R"yaml(
nodes: {{a: {{}}, b: {{position: [0.5, 0, 0]}}}}
elements:
  b1: {{type: rigid_body, node: a, mass: 1, inertia: [0.01, 0.01, 0.01]}}
  b2: {{type: rigid_body, node: b, mass: 1, inertia: [0.03, 0.03, 0.03]}}
joints:
  h1: {{type: hinge, nodes: [ground, a], axis: [0, 0, 1]}}
  h2: {{type: hinge, nodes: [ground, b], axis: [0, 0, 1]}}
  belt: {{type: belt, nodes: [a, b], radii: {}, axis: [0, 0, 1], EA: 2e4, pretension: 300, damping: 1e-3}}
)yaml",
                     radii) +
         more;
}

}  // namespace

TEST_CASE("an open and a crossed belt turn pulleys in the ratio of their radii") {
  struct Case {
    const char* radii;
    double ratio;
  };
  for (const Case& each : {Case{"[0.1, 0.2]", 0.5}, Case{"[0.1, -0.2]", -0.5}})
    move_to(belt_drive(each.radii, "drives: {motor: {joint: h1, angle: \"100*(t - 1 + exp(-t))\"}}\n"), 0.002, 4,
            [&](const Session& session) {
              const double first = session.read("joints/h1/coordinate")[0];
              CHECK(first > 300);
              // The flywheel lags by its inertia: J alpha/r_2^2 over the stiffness of the spans, about 1e-4 rad.
              CHECK(session.read("joints/h2/coordinate")[0] == Approx(each.ratio * first).margin(2e-4));
              for (const double tension : session.read("joints/belt/tension"))
                CHECK(tension == Approx(300).epsilon(0.02));
            });
}

TEST_CASE("spans of a belt share the torque: the tight side and the slack side") {
  // Pulley 2 is held, 10 N m act on pulley 1. Both spans have l = sqrt(0.5^2 - 0.1^2); with a turn by theta T = EA e/(l
  // - e), e = e_0 -+ r theta: T_1 - T_2 = 10/r. The solution is found here by Newton's method.
  const double l = std::sqrt(0.25 - 0.01), EA = 2e4, e_0 = 300 * l / (EA + 300);
  double stretch = 0;
  const auto tension = [&](double e) { return EA * e / (l - e); };
  for (int k = 0; k < 50; ++k) {
    const double f = tension(e_0 + stretch) - tension(e_0 - stretch) - 100;
    const double slope = EA * l * (1 / std::pow(l - e_0 - stretch, 2) + 1 / std::pow(l - e_0 + stretch, 2));
    stretch -= f / slope;
  }
  std::string text =
      belt_drive("[0.1, 0.2]", "drives: {load: {joint: h1, torque: 10}, brake: {joint: h2, angle: 0}}\n");
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  CHECK(session.read("joints/h1/coordinate")[0] == Approx(stretch / 0.1).epsilon(1e-9));
  const std::vector<double> tensions = session.read("joints/belt/tension");
  REQUIRE(tensions.size() == 2);
  CHECK(std::max(tensions[0], tensions[1]) == Approx(tension(e_0 + stretch)).epsilon(1e-9));
  CHECK(std::min(tensions[0], tensions[1]) == Approx(tension(e_0 - stretch)).epsilon(1e-9));
  CHECK(session.read("joints/h2/drive_force")[0] == Approx(-20).epsilon(1e-8));
  // The bearings carry the tensions along the spans, which are inclined by asin(0.1/0.5).
  const double along = (tensions[0] + tensions[1]) * l / 0.5;
  CHECK(std::abs(session.read("joints/h1/reaction_inertial")[0]) == Approx(along).epsilon(1e-8));
}

TEST_CASE("a hoist lifts by its drum's circumference per turn, and its rope becomes stiffer") {
  // The drum of 0.15 m is at 6 m height, and the rope leaves it downwards at x = 0.15; the load of 40 kg hangs 5 m
  // below.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  drum: {position: [0, 0, 6]}
  load: {position: [0.15, 0, 1], fixed: [rx, ry, rz]}
elements:
  b: {type: rigid_body, node: drum, mass: 1, inertia: [0.1, 0.1, 0.1]}
  m: {type: point_mass, node: load, mass: 40}
joints:
  axle: {type: hinge, nodes: [ground, drum], axis: [0, 1, 0]}
  rope: {type: cable, nodes: [load, drum], radii: [0, 0.15], axis: [0, -1, 0], EA: 1e6, pretension: 392.4, damping: 0.01}
drives: {motor: {joint: axle, angle: "-20*step(t, 0, 4)"}}
)yaml";
  move_to(text, 0.005, 5, [](const Session& session) {
    // 3 m of rope are wound up; each metre has kept its strain T/EA on the drum.
    const double strain = 392.4 / 1e6, wound = 3.0;
    CHECK(session.node("load").x.z() == Approx(1 + wound).margin(2 * strain * wound));
    CHECK(session.read("joints/rope/tension")[0] == Approx(392.4).epsilon(1e-4));
    CHECK(session.read("joints/rope/length")[0] == Approx(2).epsilon(1e-3));
    CHECK(session.read("joints/axle/drive_force")[0] == Approx(-392.4 * 0.15).epsilon(1e-4));
  });
}

TEST_CASE("a tackle with two falls halves the force and doubles the way") {
  // The rope leads from the ceiling down around the block and up over a pulley to a hand at x = -1.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  ceiling: {position: [0, 0, 3], fixed: true}
  block: {position: [0.1, 0, 1]}
  top: {position: [0.3, 0, 3], fixed: true}
  hand: {position: [0.4, 0, 1], fixed: [x, y, rx, ry, rz]}
elements:
  load: {type: rigid_body, node: block, mass: 10, inertia: [0.1, 0.1, 0.1], centre: [0, 0, -0.05]}
  weight: {type: point_mass, node: hand, mass: 5}
joints:
  rope: {type: cable, nodes: [ceiling, block, top, hand], radii: [0, 0.1, -0.1, 0], axis: [0, -1, 0], EA: 1e5,
         pretension: 49.05}
)yaml";
  // In equilibrium 10 kg hang on two falls, 5 kg on one.
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  bielle::mechanism::DynamicsOptions options;
  options.duration = 0.2;
  options.stepping.size = 0.002;
  session.dynamics(options).finish();
  CHECK(session.read("joints/rope/tension")[0] == Approx(49.05).epsilon(1e-8));
  CHECK(session.node("block").x.z() == Approx(1).margin(1e-8));
  CHECK(session.node("hand").x.z() == Approx(1).margin(1e-8));
}

TEST_CASE("the unequal weights of a tackle fall with the acceleration of its ratio") {
  // m_1 on two falls, m_2 on one: a_1 (up) = g (2 m_2 - m_1)/(m_1 + 4 m_2); the rope is stiff and without mass.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  ceiling: {position: [0, 0, 3], fixed: true}
  block: {position: [0.1, 0, 1], fixed: [x, y, rx, ry, rz]}
  top: {position: [0.3, 0, 3], fixed: true}
  hand: {position: [0.4, 0, 2], fixed: [x, y, rx, ry, rz]}
elements:
  load: {type: point_mass, node: block, mass: 10}
  weight: {type: point_mass, node: hand, mass: 7}
joints:
  rope: {type: cable, nodes: [ceiling, block, top, hand], radii: [0, 0.1, -0.1, 0], axis: [0, -1, 0], EA: 1e9, damping: 1e-3,
         pretension: 54.213157894736846}
)yaml";
  const double a = 9.81 * (14 - 10) / (10 + 28.0);
  move_to(text, 0.001, 0.5, [&](const Session& session) {
    CHECK(session.node("block").x.z() == Approx(1 + 0.5 * a * 0.25).epsilon(1e-5));
    CHECK(session.node("hand").x.z() == Approx(2 - a * 0.25).epsilon(1e-5));
    CHECK(session.read("joints/rope/tension")[0] == Approx(5 * (9.81 + a)).epsilon(1e-4));
  });
}

TEST_CASE("a rope that becomes slack lets a mass fly, and catches it when it is taut") {
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  top: {fixed: true}
  mass: {position: [0, 0, -1], velocity: [0, 0, 2], fixed: [x, y, rx, ry, rz]}
elements: {m: {type: point_mass, node: mass, mass: 2}}
joints: {rope: {type: cable, nodes: [top, mass], radii: [0, 0], EA: 1e5}}
)yaml";
  const double back = 2 * 2 / 9.81;  // when it returns down, at 2 m/s
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<double> times;
  session.on_event([&](const bielle::mechanism::Event& event) { times.push_back(event.time); });
  bielle::mechanism::DynamicsOptions options;
  options.duration = 0.6;
  options.stepping.size = 2e-4;
  bielle::mechanism::Motion motion = session.dynamics(options);
  motion.advance_to(0.2);
  CHECK(session.node("mass").x.z() == Approx(-1 + 2 * 0.2 - 0.5 * 9.81 * 0.04).epsilon(1e-9));
  CHECK(session.read("joints/rope/tension")[0] == 0);
  motion.finish();
  REQUIRE(times.size() == 2);
  CHECK(times[0] == Approx(back).epsilon(1e-6));
  // After half a period of the spring it separates again with the speed of its arrival.
  CHECK(times[1] - times[0] == Approx(M_PI * std::sqrt(2 / 1e5)).epsilon(0.03));
  CHECK(motion.balance() == Approx(0).margin(1e-3));
}
