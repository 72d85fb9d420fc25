// `start: equilibrium` for models that are not held, and with coordinates that are held while the rest settles.
#include <cmath>
#include <exception>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using Catch::Contains;

namespace {

constexpr double g = 9.81;

/// Returns two masses on a bar that turns about y, each with a moment of 100 N m; one of them is farther out.
std::string balance(double farther) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{bar: {{}}, left: {{position: [-1, 0, 0]}}, right: {{position: [{:.17g}, 0, 0]}}}}
elements:
  bar: {{type: rigid_body, node: bar, mass: 1, inertia: [0.1, 0.1, 0.1], also: [left, right]}}
  one: {{type: point_mass, node: left, mass: {:.17g}}}
  other: {{type: point_mass, node: right, mass: {:.17g}}}
joints: {{pivot: {{type: hinge, nodes: [ground, bar], axis: [0, 1, 0], start_rate: 2, carries: all}}}}
)yaml",
                     1 + farther, 100 / g, 100 / g);
}

/// Returns the angle of the bar after settling, and the report.
double settled_angle(const std::string& text, std::string& report) {
  Session session(read_mechanism_text(text, "model.yaml").model);
  DynamicsOptions options;
  options.duration = options.stepping.size = 1e-4;
  options.equilibrium = true;
  const Motion motion = session.dynamics(options);
  report = format_start(motion.start());
  CHECK(session.read("joints/pivot/rate")[0] == Approx(2).epsilon(1e-12));
  return session.read("joints/pivot/coordinate")[0];
}

/// Returns a tower with a rotor in front, whose centre is off its axis; `analysis` is its only one.
std::string tower(const std::string& start) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  foot: {{fixed: true}}
  top: {{position: [0, 0, 10]}}
  rotor: {{position: [0.5, 0, 10]}}
elements:
  tower:
    type: beam
    nodes: [foot, top]
    elements: 4
    section: {{EA: 1e9, GAy: 1e9, GAz: 1e9, GJ: 1e9, EIy: 1e8, EIz: 1e8, mass_per_length: 1e-3, Jx: 1e-3, Jy: 1e-3, Jz: 1e-3}}
  nacelle: {{type: rigid_body, node: top, mass: 1, inertia: [1, 1, 1]}}
  rotor: {{type: rigid_body, node: rotor, mass: 20, centre: [0, 0.3, 0], inertia: [5, 4, 3]}}
joints:
  shaft: {{type: hinge, nodes: [top, rotor], axis: [1, 0, 0], start_rate: 6, carries: all}}
analysis: [{{type: dynamic, duration: 1e-3, step: 1e-3, start: {}}}]
)yaml",
                     start);
}

}  // namespace

TEST_CASE("what is balanced to the accuracy of its loads is in equilibrium, though nothing holds it") {
  std::string report;
  // The moments are 4e-6 N m under 100 N m on either side.
  CHECK(std::abs(settled_angle(balance(4e-8), report)) < 1e-6);
  CHECK(std::abs(settled_angle(balance(-4e-8), report)) < 1e-6);
  CHECK(std::abs(settled_angle(balance(0), report)) < 1e-6);
  CHECK(std::abs(settled_angle(balance(1e-16), report)) < 1e-6);
}

TEST_CASE("what is out of balance goes down to where it hangs") {
  std::string report;
  // The heavier side is at the bottom: a quarter of a turn.
  CHECK(std::abs(settled_angle(balance(1e-2), report)) == Approx(M_PI / 2).epsilon(1e-5));
}

TEST_CASE("a tower settles while its rotor is held at the start, and then turns") {
  const MechanismFile file = read_mechanism_text(tower("{equilibrium: true, hold: [shaft]}"), "tower.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = options.stepping.size = 1e-3;
  options.equilibrium = true;
  options.held = {{file.model.components_of({Section::joints, "shaft"}).front(), 0}};
  const Motion motion = session.dynamics(options);
  CHECK(std::abs(session.read("joints/shaft/coordinate")[0]) < 1e-11);
  CHECK(session.read("joints/shaft/rate")[0] == Approx(6).epsilon(1e-12));
  // A cantilever under end moments: m g c about y, m g e about x, and nothing that stiffens it to speak of.
  constexpr double L = 10, EI = 1e8, M_y = 20 * g * 0.5, M_x = -20 * g * 0.3;
  const NodeState& top = session.node("top");
  CHECK(top.x.x() == Approx(M_y * L * L / (2 * EI)).epsilon(1e-3));
  CHECK(top.x.y() == Approx(-M_x * L * L / (2 * EI)).epsilon(1e-3));
  // The tower is at rest, the rotor turns about its axis.
  CHECK(top.v.norm() < 1e-12);
  CHECK(top.Omega.norm() < 1e-12);
  CHECK(motion.energy().kinetic == Approx(0.5 * 36 * (5 + 20 * 0.3 * 0.3)).epsilon(1e-9));
}

TEST_CASE("keys of a start are refused with a reason") {
  const auto refusal = [](const std::string& start) {
    return message_of<std::exception>([&] { read_mechanism_text(tower(start), "tower.yaml"); });
  };
  CHECK(refusal("{equilibrium: true, hold: [shaft]}") == "(nothing thrown)");
  CHECK(refusal("{equilibrium: true, hold: [shaft.angle]}") == "(nothing thrown)");
  CHECK(refusal("{equilibrium: true, hold: [{joint: shaft, coordinate: angle}]}") == "(nothing thrown)");
  CHECK(refusal("{equilibrium: true, hold: []}") == "(nothing thrown)");
  CHECK(refusal("{equilibrium: false}") == "(nothing thrown)");
  CHECK_THAT(refusal("{equilibrium: true, hold: [shafft]}"), Contains("shaft"));
  CHECK_THAT(refusal("{equilibrium: true, hold: [shaft.angel]}"), Contains("angle"));
  CHECK_THAT(refusal("{equilibrium: true, hold: [shaft, shaft.angle]}"), Contains("twice"));
  CHECK_THAT(refusal("{equilibrium: false, hold: [shaft]}"), Contains("equilibrium: true"));
  CHECK_THAT(refusal("{hold: [shaft]}"), Contains("equilibrium"));
  CHECK_THAT(refusal("{equilibrium: true, holds: [shaft]}"), Contains("hold"));
  CHECK_THAT(refusal("equilibrum"), Contains("equilibrium"));
}
