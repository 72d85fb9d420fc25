// Kinematics and inverse dynamics of rigid machines: dwells, events, and messages about motions that are not driven.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using Catch::Contains;

namespace {

constexpr double g = 9.81;

/// Returns a horizontal arm of 1 kg, 0.5 m from its hinge, that the hinge's angle lowers.
std::string arm(const std::string& angle) {
  return fmt::format(
      "gravity: [0, 0, -9.81]\nnodes: {{arm: {{position: [0.5, 0, 0]}}}}\n"
      "elements: {{arm: {{type: rigid_body, node: arm, mass: 1, inertia: [0.01, 0.08, 0.08]}}}}\n"
      "joints: {{pivot: {{type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0]}}}}\n"
      "drives: {{motor: {{joint: pivot, angle: \"{}\"}}}}\n",
      angle);
}

}  // namespace

TEST_CASE("inverse dynamics runs through dwells, with the torque that holds the arm there") {
  struct Law {
    const char* angle;
    double waits_until, moved_by, angle_at_end;
  };
  for (const Law& law : {Law{"0.5*step(t, 0.05, 0.3)", 0.05, 0.3, 0.5}, Law{"0", 0.6, 0.6, 0},
                         Law{"0.5*step(t, 0.05, 0.3) - 0.5*step(t, 0.4, 0.5)", 0.05, 0.5, 0},
                         Law{"0.2*step(t, 0.0505, 0.10033)", 0.0505, 0.10033, 0.2},
                         Law{"if(t < 0.1, 0, if(t < 0.3, 0.25*(1 - cos(5*pi*(t - 0.1))), 0.5))", 0.1, 0.3, 0.5},
                         Law{"0.4*t^6/(t^6 + 1e-6)", 0, 2, 0}})
    for (const double step : {1e-3, 0.01}) {
      CAPTURE(law.angle, step);
      const MechanismFile file = read_mechanism_text(arm(law.angle), "model.yaml");
      Session session(file.model);
      long looked = 0;
      session.on_step([&](Session& at) {
        const double t = at.time(), angle = t > law.moved_by ? law.angle_at_end : 0;
        if (t > law.waits_until - 1e-9 && t < law.moved_by + 1e-9) return;
        ++looked;
        CHECK(at.read("joints/pivot/drive_force")[0] == Approx(-g * 0.5 * std::cos(angle)).epsilon(1e-9));
      });
      CHECK(compute_kinematics(session, {.duration = 0.6, .step = step}).points >= 61);
      if (law.moved_by < 0.6) CHECK(looked > 5);
    }
}

TEST_CASE("a closed loop of spherical and universal joints waits, moves and waits") {
  const MechanismFile file = read_mechanism_text(
      "nodes: {crank: {position: [0.1, 0, 0]}, rod: {position: [0.45, 0, 0.15], axes: {x: [0.5, 0, 0.3], y: [0, 1, "
      "0]}},\n"
      "        rocker: {position: [0.7, 0, 0.15]}}\n"
      "elements:\n  crank: {type: rigid_body, node: crank, mass: 1, inertia: [0.01, 0.01, 0.01]}\n"
      "  rod: {type: rigid_body, node: rod, mass: 1, inertia: [0.01, 0.01, 0.01]}\n"
      "  rocker: {type: rigid_body, node: rocker, mass: 1, inertia: [0.01, 0.01, 0.01]}\n"
      "joints:\n  a: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 1, 0]}\n"
      "  b: {type: spherical, nodes: [crank, rod], position: [0.2, 0, 0]}\n"
      "  c: {type: universal, nodes: [rocker, rod], position: [0.7, 0, 0.3], axis: [0, 1, 0], second_axis: [-0.3, 0, "
      "0.5]}\n"
      "  d: {type: hinge, nodes: [ground, rocker], position: [0.7, 0, 0], axis: [0, 1, 0]}\n"
      "drives: {motor: {joint: a, angle: \"0.3*step(t, 0.05, 0.3)\"}}\n",
      "model.yaml");
  Session session(file.model);
  const KinematicsReport report = compute_kinematics(session, {.duration = 0.6, .step = 2e-3});
  CHECK(report.points == 301);
  CHECK(std::abs(report.balance) < 1e-6);  // no gravity: the energy supplied is returned where the machine rests again
}

TEST_CASE("kinematics names the motions that are not driven, by their joints") {
  const MechanismFile two = read_mechanism_text(
      "nodes: {a: {position: [0.5, 0, 0]}, b: {position: [1.5, 0, 0]}, c: {position: [0, 3, 0]}}\n"
      "elements:\n  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
      "  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
      "  c: {type: rigid_body, node: c, mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
      "joints:\n  upper: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0]}\n"
      "  lower: {type: hinge, nodes: [a, b], position: [1, 0, 0], axis: [0, 1, 0]}\n"
      "  rail: {type: prismatic, nodes: [ground, c], axis: [1, 0, 0]}\n"
      "drives: {motor: {joint: upper, angle: \"t\"}}\n",
      "model.yaml");
  Session session(two.model);
  const std::string said =
      message_of<std::runtime_error>([&] { compute_kinematics(session, {.duration = 1, .step = 0.1}); });
  CHECK_THAT(said, Contains("2 degrees of freedom are not driven") && Contains("angle of joint 'lower'") &&
                       Contains("displacement of joint 'rail'") && !Contains("'upper'"));
  const MechanismFile floating = read_mechanism_text(
      "nodes: {a: {}}\nelements: {a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}}\n", "model.yaml");
  Session free(floating.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_kinematics(free, {.duration = 1, .step = 0.1}); }),
             Contains("6 degrees of freedom are not driven") && Contains("displacement x of node 'a'") &&
                 Contains("rotation z of node 'a'"));
}

TEST_CASE("links that stand in line at the start are said to do so") {
  const MechanismFile file = read_mechanism_text(
      "nodes: {c1: {position: [0.1, 0, 0]}, c2: {position: [0.6, 0, 0]}, k: {position: [0.45, 0, 0]}}\n"
      "elements:\n  c1: {type: rigid_body, node: c1, mass: 1, inertia: [0.001, 0.004, 0.004]}\n"
      "  c2: {type: rigid_body, node: c2, mass: 1, inertia: [0.001, 0.004, 0.004]}\n"
      "  k: {type: rigid_body, node: k, mass: 2, inertia: [0.001, 0.04, 0.04]}\n"
      "joints:\n  o1: {type: hinge, nodes: [ground, c1], position: [0, 0, 0], axis: [0, 0, 1]}\n"
      "  o2: {type: hinge, nodes: [ground, c2], position: [0.5, 0, 0], axis: [0, 0, 1]}\n"
      "  p1: {type: hinge, nodes: [c1, k], position: [0.2, 0, 0], axis: [0, 0, 1]}\n"
      "  p2: {type: hinge, nodes: [c2, k], position: [0.7, 0, 0], axis: [0, 0, 1]}\n"
      "drives: {d: {joint: o1, angle: \"5*t\"}}\n",
      "model.yaml");
  Session session(file.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_kinematics(session, {.duration = 1, .step = 0.1}); }),
             Contains("singular position (links in line, a dead centre)") && Contains("joint 'p2'"));
}

TEST_CASE("kinematics lists events where they happen") {
  const MechanismFile file = read_mechanism_text(
      arm("3*t + 0.5*t^2") +
          "events:\n  up: {when: pivot.angle, crosses: 0.7}\n  back: {when: arm.position.x, crosses: -0.2}\n"
          "  end: {when: pivot.angle, crosses: 4, action: stop}\n",
      "model.yaml");
  for (const double step : {0.1, 1e-3, 0.0077}) {
    Session session(file.model);
    std::vector<std::pair<std::string, double>> events;
    session.on_event([&](const Event& event) { events.emplace_back(event.name, event.time); });
    const KinematicsReport report = compute_kinematics(session, {.duration = 2, .step = step});
    const auto time_of = [](double angle) { return -3 + std::sqrt(9 + 2 * angle); };
    const double back = std::acos(-0.4);
    REQUIRE(events.size() == 3);
    CHECK(events[0].first == "event 'up'");
    CHECK(events[0].second == Approx(time_of(0.7)).margin(2e-9 * step));
    CHECK(events[1].second == Approx(time_of(back)).margin(2e-9 * step));
    CHECK(events[1].first == "event 'back'");
    // The arm would return to x = -0.2 m at 2 pi - back = 4.30 rad, after the end of the motion.
    CHECK(events.back().first == "event 'end'");
    CHECK(session.time() == Approx(time_of(4)).margin(2e-9 * step));
    CHECK(report.stopped_by_event);
    CHECK(report.events == 3);
  }
}

TEST_CASE("a flat follower lifts off where its force vanishes, in inverse dynamics as in dynamics") {
  // The cam is an eccentric circle, whose middle is opposite to the follower at first: N = m (g - e w^2 cos(pi + w t)).
  constexpr double R = 0.04, e = 0.01, w = 50;
  const bielle::test::TemporaryFolder folder;
  {
    std::ofstream out(folder.path() + "/circle.csv");
    for (int k = 0; k < 720; ++k) {
      const double phi = 2 * M_PI * k / 720;
      out << fmt::format("{:.17g}, {:.17g}\n", phi,
                         -e * std::cos(phi) + std::sqrt(R * R - std::pow(e * std::sin(phi), 2)));
    }
  }
  const MechanismFile file = read_mechanism_text(
      fmt::format(
          "gravity: [-9.81, 0, 0]\nnodes: {{c: {{}}, f: {{position: [{}, 0, 0]}}}}\n"
          "elements:\n  c: {{type: rigid_body, node: c, mass: 1, inertia: [0.01, 0.01, 0.01]}}\n"
          "  f: {{type: rigid_body, node: f, mass: 0.5, inertia: [0.01, 0.01, 0.01]}}\n"
          "joints:\n  shaft: {{type: hinge, nodes: [ground, c], axis: [0, 0, 1], second_axis: [1, 0, 0]}}\n"
          "  guide: {{type: prismatic, nodes: [ground, f], axis: [1, 0, 0]}}\n"
          "  cam: {{type: cam, joints: [shaft, guide], profile: \"{}/circle.csv\", follower: flat, at: [0, 0, 0], "
          "normal: [1, 0, 0]}}\n"
          "drives: {{d: {{joint: shaft, angle: \"{}*t\"}}}}\n",
          R - e, folder.path(), w),
      "model.yaml");
  Session session(file.model);
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  compute_kinematics(session, {.duration = 0.2, .step = 1e-3});
  REQUIRE(events.size() == 2);  // 1.6 turns
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(events[k].name == "joint 'cam': lifts off");
    // The spline's curvature is accurate to 6e-6.
    CHECK(events[k].time ==
          Approx((M_PI - std::acos(g / (e * w * w)) + 2 * M_PI * static_cast<double>(k)) / w).margin(2e-7));
  }
}
