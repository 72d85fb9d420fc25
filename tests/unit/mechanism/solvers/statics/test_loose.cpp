// Parts without support and load stay as drawn in statics: links between spherical joints, wheels.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::message_of;

namespace {

constexpr double stiffness = 1000, force = 50;

/// Returns a slider on a spring, pushed through links end to end that can each turn about their own axis.
/// @param moment  on the first link, about its axis [N m]
std::string links(int count, double moment, const std::string& inertia = "[1e-3, 1e-3, 1e-3]") {
  std::string nodes, elements, joints;
  for (int i = 0; i < count; ++i) {
    nodes += fmt::format("  link{}: {{position: [{}, 0, 0], rotation_vector: [0.3, 0, 0]}}\n", i, i + 0.5);
    elements += fmt::format("  link{}: {{type: rigid_body, node: link{}, mass: 1, inertia: {}}}\n", i, i, inertia);
    joints += fmt::format("  pin{}: {{type: spherical, nodes: [{}, link{}], position: [{}, 0, 0]}}\n", i,
                          i == 0 ? "push" : fmt::format("link{}", i - 1), i, i);
  }
  return fmt::format(
      "nodes:\n  push: {{position: [0, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
      "  slider: {{position: [{0}, 0, 0], fixed: [y, z, rx, ry, rz]}}\n{1}"
      "elements:\n  spring: {{type: spring_damper, nodes: [ground, slider], stiffness: {2}, length: {0}}}\n{3}"
      "joints:\n{4}  last: {{type: spherical, nodes: [link{5}, slider], position: [{0}, 0, 0]}}\n"
      "loads:\n  push: {{node: push, force: [{6}, 0, 0]}}\n  twist: {{node: link0, moment: [{7}, 0, 0]}}\n",
      count, nodes, stiffness, elements, joints, count - 1, force, moment);
}

}  // namespace

TEST_CASE("a link that can turn about its axis stays as drawn, and the summary names it") {
  for (const auto& inertia : {"[1e-3, 1e-3, 1e-3]", "[0, 1e-3, 1e-3]"})
    for (const int steps : {1, 5, 0}) {
      const MechanismFile file = read_mechanism_text(links(1, 0, inertia), "links.yaml");
      Session session(file.model);
      StaticsOptions options;
      options.steps = steps;
      const StaticsReport report = compute_statics(session, options);
      CAPTURE(steps, report.log.loose);
      CHECK(session.node("slider").x[0] - 1 == Approx(force / stiffness).epsilon(1e-9));
      CHECK(log_so3(session.node("link0").R).isApprox(Vector3(0.3, 0, 0), 1e-9));
      CHECK_THAT(report.log.loose, Catch::Contains("rotation x of node 'link0'"));
      CHECK(report.log.unstable == 0);
      CHECK(report.iterations <= 4 * report.points);  // as fast as without
    }
}

TEST_CASE("a moment about an axis that nothing holds has no equilibrium") {
  for (const double moment : {0.1, 1e-4}) {  // the smaller one turns the link slightly in each iteration
    const MechanismFile file = read_mechanism_text(links(1, moment), "links.yaml");
    Session session(file.model);
    CHECK_THAT(message_of<ComputationError>([&] { compute_statics(session, {}); }),
               Catch::Contains("no equilibrium") &&
                   Catch::Contains("nothing holds rotation x of node 'link0' against its load"));
  }
}

TEST_CASE("a path of equilibria leaves what is loose where it is") {
  const MechanismFile file = read_mechanism_text(links(1, 0), "links.yaml");
  Session session(file.model);
  StaticsOptions options;
  options.path.emplace();
  options.path->end.load_factor = 1;
  const StaticsReport report = compute_statics(session, options);
  CHECK(session.node("slider").x[0] - 1 == Approx(force / stiffness).epsilon(1e-9));
  CHECK_THAT(report.log.loose, Catch::Contains("link0"));
}

TEST_CASE("a load that can turn about its rope is named, whatever gear and drum hold the other end") {
  // The gear and the rope that winds make the elimination find no pivot at an unknown that is held.
  for (const double mass : {50., 500.})
    for (const double ratio : {-0.025, 0.025, -0.5}) {
      const MechanismFile file = read_mechanism_text(fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{drum: {{position: [0, 0, 5]}}, shaft: {{position: [0, 0.5, 5]}}, load: {{position: [0.2, 0, 0]}}}}
elements:
  drum: {{type: rigid_body, node: drum, mass: 100, inertia: [3, 3, 3]}}
  rotor: {{type: rigid_body, node: shaft, mass: 10, inertia: [0.1, 0.1, 0.1]}}
  load: {{type: rigid_body, node: load, solid: {{box: [0.6, 0.6, 0.4], mass: {}}}}}
joints:
  axle: {{type: hinge, nodes: [ground, drum], axis: [0, 1, 0], locked: true}}
  motor: {{type: hinge, nodes: [ground, shaft], axis: [0, 1, 0]}}
  gear: {{type: gear, joints: [motor, axle], ratio: {}}}
  rope: {{type: cable, nodes: [drum, load], at: [~, [0, 0, 0.2]], radii: [0.2, 0], axis: [0, 1, 0], EA: 4e6}}
)yaml",
                                                                 mass, ratio),
                                                     "hoist.yaml");
      CAPTURE(mass, ratio);
      Session session(file.model);
      CHECK(compute_statics(session, {}).log.loose == "rotation z of node 'load'");
    }
}
