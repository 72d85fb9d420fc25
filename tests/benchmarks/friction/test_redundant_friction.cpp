// Friction by reactions that are not unique: it uses those of smallest norm, and accelerations are found at the start
// of motions and after events, however nearly redundant constraints are.
//
// Two guides side by side share the load of a block equally. A leg of planar hinges, closed in space, has one hinge
// with only redundant constraints: with a cylindrical joint in its place it moves in the same way.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

namespace {

/// Returns the acceleration at the start of a block that slides at 2 m/s in two guides.
double deceleration(double mu_1, double mu_2) {
  const std::string text = fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{block: {{velocity: [2, 0, 0]}}}}
elements: {{block: {{type: rigid_body, node: block, mass: 3, inertia: [0.1, 0.1, 0.1]}}}}
joints:
  left: {{type: prismatic, nodes: [ground, block], position: [0, 0.2, 0], axis: [1, 0, 0], friction: {{coefficient: {}, velocity: 1e-3}}}}
  right: {{type: prismatic, nodes: [ground, block], position: [0, -0.2, 0], axis: [1, 0, 0], friction: {{coefficient: {}, velocity: 1e-3}}}}
)yaml",
                                       mu_1, mu_2);
  Session session(read_mechanism_text(text, "block.yaml").model);
  DynamicsOptions options;
  options.duration = options.stepping.size = 1e-3;
  const Motion motion = session.dynamics(options);
  return -session.node("block").a.x();
}

/// Returns a wheel on a leg that drops onto the ground at speed. @param brace  type of the joint whose constraints may
/// be redundant
std::string leg(const std::string& brace) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
parameters: {{sink: 3, speed: 50, ro: 0.045, ri: 0.038}}
nodes:
  craft: {{position: [0, 0, 0], fixed: [y, rx, ry, rz], velocity: [speed, 0, -sink]}}
  tube: {{position: [0, 0, -0.4], velocity: [speed, 0, -sink]}}
  head: {{position: [0, 0, -0.6], velocity: [speed, 0, -sink]}}
  axle: {{position: [0, 0, -1.25], velocity: [speed, 0, -sink]}}
  wheel: {{position: [0, 0, -1.25], velocity: [speed, 0, -sink]}}
  upper: {{position: [0.535, 0, -0.185], velocity: [speed, 0, -sink]}}
  lower: {{position: [0.185, 0, -0.535], velocity: [speed, 0, -sink]}}
elements:
  craft: {{type: point_mass, node: craft, mass: 2000}}
  tube: {{type: rigid_body, node: tube, mass: 25, inertia: [1.2, 1.2, 0.06]}}
  head: {{type: point_mass, node: head, mass: 2}}
  piston:
    type: beam
    nodes: [head, axle]
    elements: 6
    orientation: [1, 0, 0]
    section: {{tube: [ro, ri], young: 210e9, poisson: 0.3, density: 7850}}
    damping: 2e-4
  wheel: {{type: rigid_body, node: wheel, mass: 30, inertia: [0.9, 1.7, 0.9]}}
  upper: {{type: rigid_body, node: upper, mass: 4, inertia: [0.05, 0.05, 0.05]}}
  lower: {{type: rigid_body, node: lower, mass: 4, inertia: [0.05, 0.05, 0.05]}}
  strut:
    type: hydraulic_actuator
    nodes: [tube, head]
    at: [[0, 0, 0.4], [0, 0, 0]]
    stroke: [0.28, 0.6]
    piston_areas: [6e-3, 0]
    ports: [oil]
    end_stops: {{stiffness: 1e8, damping: 1e5}}
joints:
  trunnion: {{type: hinge, nodes: [craft, tube], position: [0, 0, 0], axis: [0, -1, 0]}}
  bearing: {{type: prismatic, nodes: [tube, head], position: [0, 0, -0.6], axis: [0, 0, 1], friction: {{coefficient: 0.02, arm: 0.1, velocity: 0.02}}}}
  hub: {{type: hinge, nodes: [axle, wheel], axis: [0, 1, 0]}}
  brace: {{type: {}, nodes: [craft, upper], position: [0.7, 0, 0], axis: [0, -1, 0]}}
  knee: {{type: hinge, nodes: [upper, lower], position: [0.37, 0, -0.37], axis: [0, -1, 0], locked: {{}}}}
  foot: {{type: spherical, nodes: [tube, lower], position: [0, 0, -0.7]}}
  tyre:
    type: contact
    shapes: [{{node: ground, plane: [0, 0, 1], at: [0, 0, -1.601]}}, {{node: wheel, sphere: 0.35}}]
    stiffness: 4e5
    exponent: 1
    damping: 0.2
    friction: {{coefficient: 0.3, velocity: 2}}
hydraulics:
  ambient_pressure: 101325
  fluid: {{density: 850, viscosity: 0.02, bulk_modulus: 1.4e9}}
  volumes: {{oil: {{volume: 1e-4, pressure: 1e6}}, gas: {{volume: 1e-4, pressure: 1e6}}}}
  accumulators: {{nitrogen: {{at: gas, gas_volume: 1.98e-3, precharge: 1e6, exponent: 1.3}}}}
  lines: {{meter: {{from: oil, to: gas, orifice: {{area: 2e-4}}}}}}
loads: {{wing: {{node: craft, force: [0, 0, 19620]}}}}
)yaml",
                     brace);
}

Energy dropped(const std::string& brace) {
  Session session(read_mechanism_text(leg(brace), "leg.yaml").model);
  DynamicsOptions options;
  options.duration = 0.5;
  options.stepping.size = 2e-4;
  options.stepping.tolerance = 1e-6;
  options.stepping.largest = 1e-3;
  Motion motion = session.dynamics(options);
  CHECK(motion.finish());
  CHECK(std::abs(motion.balance()) < 1e-5 * motion.energy().kinetic);
  return motion.energy();
}

}  // namespace

TEST_CASE("two guides side by side share the weight that presses them") {
  for (const auto& [mu_1, mu_2] : {std::pair(0.3, 0.3), std::pair(0.9, 0.1), std::pair(0.1, 2.0)}) {
    CAPTURE(mu_1, mu_2);
    CHECK(deceleration(mu_1, mu_2) == Approx(0.5 * (mu_1 + mu_2) * 9.81).epsilon(1e-9));
  }
}

TEST_CASE("a leg with a hinge that repeats others moves as one without it, through all its events") {
  const Energy repeated = dropped("hinge"), once = dropped("cylindrical");
  CHECK(repeated.kinetic == Approx(once.kinetic).epsilon(1e-6));
  CHECK(repeated.dissipation == Approx(once.dissipation).epsilon(1e-4));
}
