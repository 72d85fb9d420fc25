// Joints that carry all parts behind them at the start (`carries: all`) as one rigid body, of any composition.
//
// Checks: kinetic energy T = 1/2 omega^2 I of rigid rotation, momentum and angular momentum of rigid bodies, and no
// vibration except the stretch by centrifugal forces.
#include <algorithm>
#include <cmath>
#include <exception>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/solvers/start/blade_section.hpp"

using namespace bielle::mechanism;
using bielle::test::blade_section;
using bielle::test::message_of;
using Catch::Contains;

namespace {

struct Start {
  double kinetic = 0, elastic = 0;
  std::string text;
  Session session;
  explicit Start(const std::string& model, bool equilibrium = false)
      : session(read_mechanism_text(model, "model.yaml").model) {
    DynamicsOptions options;
    options.duration = options.stepping.size = 1e-6;
    options.equilibrium = equilibrium;
    const Motion motion = session.dynamics(options);
    kinetic = motion.energy().kinetic;
    elastic = motion.energy().elastic;
    text = format_start(motion.start());
  }
  Vector3 velocity(const std::string& node) const { return session.node(node).v; }
};

/// The refusal is the message against a model; it is empty if the model starts.
std::string refusal(const std::string& model) {
  const std::string text = message_of<std::exception>([&] { const Start begun(model); });
  return text == "(nothing thrown)" ? "" : text;
}

/// Returns a hub on a shaft along x in two bearings, with two beams as blades along +-z from r = 0.2 to 2.2 m.
std::string rotor(const std::string& joints, const std::string& more_nodes = "",
                  const std::string& more_elements = "") {
  return fmt::format(R"yaml(
nodes:
  hub: {{position: [0, 0, 0]}}
  rear: {{position: [-0.5, 0, 0]}}
  up: {{position: [0, 0, 0.2]}}
  up_tip: {{position: [0, 0, 2.2]}}
  down: {{position: [0, 0, -0.2]}}
  down_tip: {{position: [0, 0, -2.2]}}
  {1}
elements:
  shaft: {{type: rigid_body, node: hub, mass: 10, inertia: [2, 1, 1], also: [rear, up, down]}}
  blade_1: {{type: beam, nodes: [up, up_tip], elements: 12, section: {0}}}
  blade_2: {{type: beam, nodes: [down, down_tip], elements: 12, section: {0}}}
  {2}
joints:
{3}
)yaml",
                     blade_section, more_nodes, more_elements, joints);
}

/// About x, hub and blades (Jy of their sections).
double rotor_inertia() { return 2 + 2 * (5 * (std::pow(2.2, 3) - std::pow(0.2, 3)) / 3 + 0.01 * 2); }

}  // namespace

TEST_CASE("a rotor of beams starts with one line as a rigid body") {
  constexpr double w = 7;
  const Start begun(rotor("  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], start_rate: 7, carries: all}"));
  CHECK(begun.kinetic == Approx(0.5 * w * w * rotor_inertia()).epsilon(1e-4));
  CHECK((begun.velocity("up_tip") - Vector3(0, -w * 2.2, 0)).norm() < 1e-12);
  CHECK((begun.velocity("down_tip") - Vector3(0, w * 2.2, 0)).norm() < 1e-12);
  CHECK(begun.session.read("joints/main/rate")[0] == Approx(w).epsilon(1e-12));
  CHECK_THAT(begun.text,
             Contains("joint 'main' carries as one rigid body: nodes 'hub', 'rear', 'up', 'up_tip', 'down', "
                      "'down_tip', 22 nodes within elements"));
}

TEST_CASE("bearings on the same axis do not stop what a joint carries, nor do springs to the ground") {
  const std::string line =
      "  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], start_rate: 7, carries: all}\n";
  const double expected = 0.5 * 49 * rotor_inertia();
  for (const char* second : {"{type: hinge, nodes: [ground, rear], axis: [1, 0, 0]}",
                             "{type: cylindrical, nodes: [rear, ground], axis: [1, 0, 0]}",
                             "{type: bushing, nodes: [ground, rear], stiffness: [1e5, 1e5, 1e5, 0, 0, 0]}"}) {
    CAPTURE(second);
    const std::string joints = line + "  second: " + second;
    CHECK(Start(rotor(joints)).kinetic == Approx(expected).epsilon(1e-4));
  }
  const std::string spring = "spring: {type: spring_damper, nodes: [ground, up_tip], stiffness: 100}";
  CHECK(Start(rotor(line, "", spring)).kinetic == Approx(expected).epsilon(1e-4));
}

TEST_CASE("a joint may have its nodes in either order, and a drive in place of a start rate") {
  const double expected = 0.5 * 49 * rotor_inertia();
  const Start reversed(
      rotor("  main: {type: hinge, nodes: [hub, ground], axis: [1, 0, 0], start_rate: -7, carries: all}"));
  CHECK(reversed.kinetic == Approx(expected).epsilon(1e-4));
  CHECK(reversed.velocity("up_tip").y() == Approx(-7 * 2.2));
  const Start driven(
      rotor("  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], carries: all}\n"
            "drives: {motor: {joint: main, rate: 7}}"));
  CHECK(driven.kinetic == Approx(expected).epsilon(1e-4));
}

TEST_CASE("a slide and a screw carry all, too") {
  constexpr double v = 3;
  const double mass = 10 + 2 * 5 * 2;
  const Start slide(
      rotor("  main: {type: prismatic, nodes: [ground, hub], axis: [1, 0, 0], start_rate: 3, carries: all}"));
  CHECK(slide.kinetic == Approx(0.5 * mass * v * v).epsilon(1e-12));
  const Start both(
      rotor("  main: {type: cylindrical, nodes: [ground, hub], axis: [1, 0, 0], start_rate: {angle: 7, "
            "displacement: 3}, carries: all}"));
  CHECK(both.kinetic == Approx(0.5 * mass * v * v + 0.5 * 49 * rotor_inertia()).epsilon(1e-4));
  // A coordinate without a given rate is at rest.
  const Start turning(rotor(
      "  main: {type: cylindrical, nodes: [ground, hub], axis: [1, 0, 0], start_rate: {angle: 7}, carries: all}"));
  CHECK(turning.kinetic == Approx(0.5 * 49 * rotor_inertia()).epsilon(1e-4));
  CHECK(std::abs(turning.velocity("hub").x()) < 1e-12);
}

TEST_CASE("a screw carries all with its lead") {
  const Start screw(
      rotor("  main: {type: screw, nodes: [ground, hub], axis: [1, 0, 0], pitch: 0.2, start_rate: {angle: 7}, carries: "
            "all}"));
  const double v = screw.velocity("hub").x(), mass = 10 + 2 * 5 * 2;
  CHECK(std::abs(v) > 1e-3);
  CHECK(screw.kinetic == Approx(0.5 * mass * v * v + 0.5 * 49 * rotor_inertia()).epsilon(1e-4));
}

TEST_CASE("joints behind joints add their own start rates") {
  // An arm along x turns about z; at its end a second arm, along y, turns about z relative to it.
  const char* text = R"yaml(
nodes:
  a: {position: [1, 0, 0]}
  b: {position: [2, 0, 0]}
  c: {position: [2, 1, 0]}
elements:
  first: {type: rigid_body, node: a, mass: 3, inertia: [0.1, 0.2, 0.3], also: [b]}
  second: {type: rigid_body, node: c, mass: 2, inertia: [0.3, 0.2, 0.4]}
joints:
  elbow: {type: hinge, nodes: [b, c], position: [2, 0, 0], axis: [0, 0, 1], start_rate: 5, carries: all}
  shoulder: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 0, 1], start_rate: 2, carries: all}
)yaml";
  const Start begun(text);
  // v_c = 2 z x (2, 1, 0) + 5 z x (0, 1, 0)
  const Vector3 v_c(-2 - 5, 4, 0);
  CHECK((begun.velocity("c") - v_c).norm() < 1e-12);
  CHECK(begun.session.node("c").Omega.z() == Approx(7));
  CHECK(begun.kinetic == Approx(0.5 * 3 * 4 + 0.5 * 0.3 * 4 + 0.5 * 2 * v_c.squaredNorm() + 0.5 * 0.4 * 49));
}

TEST_CASE("a body in flight keeps its velocity, and its wheel turns on top of it") {
  const char* text = R"yaml(
nodes:
  car: {velocity: [20, 0, 0]}
  wheel: {position: [1, 0.5, 0]}
  rim: {position: [1, 0.5, 0.3]}
elements:
  car: {type: rigid_body, node: car, mass: 100, inertia: [10, 20, 30]}
  wheel: {type: rigid_body, node: wheel, mass: 5, inertia: [0.1, 0.2, 0.1], also: [rim]}
joints:
  axle: {type: hinge, nodes: [car, wheel], axis: [0, 1, 0], start_rate: 60, carries: all}
)yaml";
  const Start begun(text);
  CHECK((begun.velocity("wheel") - Vector3(20, 0, 0)).norm() < 1e-12);
  CHECK((begun.velocity("rim") - Vector3(20 + 60 * 0.3, 0, 0)).norm() < 1e-12);
  CHECK(begun.kinetic == Approx(0.5 * 105 * 400 + 0.5 * 0.2 * 3600));
}

TEST_CASE("superelements start rigidly with their modes, settled or not") {
  bielle::test::TemporaryFolder folder;
  bielle::write_superelement(bielle::test::straight_beam().reduced().body, folder / "beam.h5");
  const auto text = [&](const std::string& more) {
    return fmt::format(R"yaml(
nodes: {{root: {{position: [0.5, 0, 0]}}}}
elements:
  arm: {{type: superelement, file: {0}, nodes: {{a: root}}, position: [0.5, 0, 0]}}
joints:
  main: {{type: hinge, nodes: [ground, root], position: [0, 0, 0], axis: [0, 0, 1], start_rate: 2, carries: all}}
{1})yaml",
                       folder / "beam.h5", more);
  };
  const double inertia = (std::pow(1.5, 3) - std::pow(0.5, 3)) / 3;
  CHECK(Start(text("")).kinetic == Approx(0.5 * 4 * inertia).epsilon(1e-9));
}

TEST_CASE("a rotor that starts rigidly stretches by centrifugal forces alone") {
  // The energy of the vibration is twice that of the static stretch at most: of a bar of tension N(r), U = int N^2/(2
  // EA), N = m w^2 (R^2 - r^2)/2.
  constexpr double w = 7, mass = 5, EA = 2e6, R = 2.2, r_0 = 0.2;
  const auto N_squared = [](double r) { return std::pow(mass * w * w * (R * R - r * r) / 2, 2); };
  double U = 0;
  constexpr int parts = 2000;
  for (int k = 0; k < parts; ++k) U += N_squared(r_0 + (k + 0.5) * (R - r_0) / parts) * (R - r_0) / parts / (2 * EA);
  Session session(read_mechanism_text(rotor("  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], start_rate: "
                                            "7, carries: all}"),
                                      "model.yaml")
                      .model);
  DynamicsOptions options;
  options.duration = 0.05;
  options.stepping.size = 1e-4;
  Motion motion = session.dynamics(options);
  double most = 0;
  while (motion.step()) most = std::max(most, motion.energy().elastic);
  CHECK(most < 4 * 2 * U * 1.02);  // two blades; (stretch twice as far: four times the energy)
  CHECK(most > 2 * U);
}

TEST_CASE("what cannot be carried is refused with a reason") {
  const std::string line =
      "  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], start_rate: 7, carries: all}\n";
  CHECK_THAT(refusal(rotor(line + "  other: {type: hinge, nodes: [ground, up_tip], axis: [0, 0, 1]}")),
             Contains("joint 'main' cannot carry") && Contains("joint 'other'"));
  CHECK_THAT(refusal(rotor(line, "",
                           fmt::format("stay: {{type: beam, nodes: [up_tip, ground], section: {}}}", blade_section))),
             Contains("joint 'main' cannot carry") && Contains("element 'stay'"));
  const auto with_tip = [&](const std::string& given) {
    std::string text = rotor(line);
    const std::string tip = "up_tip: {position: [0, 0, 2.2]";
    return text.replace(text.find(tip), tip.size(), tip + ", " + given);
  };
  CHECK_THAT(refusal(with_tip("velocity: [0, 1, 0]")),
             Contains("node 'up_tip'") && Contains("joint 'main'") && Contains("-15.4"));
  CHECK_THAT(refusal(with_tip("angular_velocity: [1, 0, 0]")),
             Contains("node 'up_tip'") && Contains("angular velocity"));
  CHECK(refusal(with_tip("velocity: [0, -15.4, 0], angular_velocity: [7, 0, 0]")).empty());
  CHECK_THAT(refusal(with_tip("fixed: [y]")), Contains("node 'up_tip'") && Contains("held"));
  CHECK_THAT(
      refusal(rotor("  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], start_rate: 7, carries: some}")),
      Contains("some"));
  CHECK_THAT(refusal(rotor(line + "drives: {motor: {joint: main, rate: 7}}")), Contains("motor"));
}

TEST_CASE("a start rate of zero, or none, carries all at rest") {
  CHECK(Start(rotor("  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], start_rate: 0, carries: all}"))
            .kinetic == 0);
  CHECK(Start(rotor("  main: {type: hinge, nodes: [ground, hub], axis: [1, 0, 0], carries: all}")).kinetic == 0);
}
