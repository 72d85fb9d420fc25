// Driven mechanisms: kinematics against closed forms, inverse dynamics against forward dynamics.
#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::message_of;
using Catch::Contains;

namespace test_kinematics {
namespace {

/// @param elements  none for a mechanism without mass
std::string slider_crank(const std::string& elements, const std::string& drive) {
  return "nodes:\n  crank: {position: [0.05, 0, 0]}\n  rod: {position: [0.2, 0, 0]}\n  piston: {position: [0.3, 0, "
         "0]}\n" +
         elements +
         "joints:\n  main: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 0, 1]}\n"
         "  pin: {type: hinge, nodes: [crank, rod], position: [0.1, 0, 0], axis: [0, 0, 1]}\n"
         "  wrist: {type: spherical, nodes: [rod, piston], position: [0.3, 0, 0]}\n"
         "  guide: {type: prismatic, nodes: [ground, piston], at: [[0, 0, 0], [0, 0, 0]], axis: [1, 0, 0]}\n" +
         drive;
}

const std::string bodies =
    "elements:\n  crank: {type: rigid_body, node: crank, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}\n"
    "  rod: {type: rigid_body, node: rod, mass: 0.5, inertia: [1e-3, 1e-3, 1e-3]}\n"
    "  piston: {type: point_mass, node: piston, mass: 0.3}\n";
const std::string driven = "drives: {motor: {joint: main, angle: \"30*t + 0.5*sin(7*t)\"}}\n";

/// Torque of a pendulum of length l, mass m and inertia J about the centre, at the angle 0.3 + sin(5 t) - sin(0)...
/// above x.
constexpr double m = 2, l = 0.4, J = 0.03, g = 9.81;
std::string pendulum(const std::string& drive) {
  return fmt::format(
      "gravity: [0, 0, -9.81]\nnodes: {{arm: {{position: [0.4, 0, 0]}}}}\n"
      "elements: {{arm: {{type: rigid_body, node: arm, mass: 2, inertia: [0.01, 0.03, 0.03]}}}}\n"
      "joints: {{foot: {{type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, -1, 0]}}}}\n"
      "drives: {{motor: {{joint: foot, {}}}}}\n",
      drive);
}

}  // namespace

TEST_CASE("kinematics of a slider-crank is that of its formula, at each time to rounding") {
  for (const bool heavy : {true, false}) {
    const MechanismFile file = read_mechanism_text(slider_crank(heavy ? bodies : "", driven), "model.yaml");
    Session session(file.model);
    long looked = 0;
    const auto look = [&](const Session& at) {
      const double t = at.time(), r = 0.1, rod = 0.2, angle = 30 * t + 0.5 * std::sin(7 * t),
                   w = 30 + 3.5 * std::cos(7 * t), a = -24.5 * std::sin(7 * t), s = std::sin(angle),
                   c = std::cos(angle), root = std::sqrt(rod * rod - r * r * s * s);
      const double x = r * c + root, x1 = -r * s - r * r * s * c / root,
                   x2 = -r * c - r * r * (c * c - s * s) / root - std::pow(r * r * s * c, 2) / std::pow(root, 3);
      const NodeState& piston = at.node("piston");
      CAPTURE(heavy, t);
      CHECK(piston.x[0] == Approx(x).epsilon(1e-12));
      CHECK(piston.v[0] == Approx(x1 * w).margin(1e-10));
      CHECK(piston.a[0] == Approx(x2 * w * w + x1 * a).margin(1e-7));
      CHECK(at.read("joints/main/coordinate")[0] == Approx(angle).margin(1e-12));  // turns are counted
      ++looked;
    };
    session.on_step([&](Session& at) { look(at); });
    const KinematicsReport report = compute_kinematics(session, {.duration = 1, .step = 0.02});
    CHECK(report.points == 51);
    CHECK(looked == 50);
  }
}

TEST_CASE("inverse dynamics gives the torque that a pendulum's motion takes") {
  // (J + m l^2) phi'' + m g l cos(phi) along phi(t) = 0.8 (1 - cos(5 t)), which starts at rest.
  const MechanismFile file = read_mechanism_text(pendulum("angle: \"0.8*(1 - cos(5*t))\""), "model.yaml");
  Session session(file.model);
  session.on_step([&](Session& at) {
    const double t = at.time(), phi = 0.8 * (1 - std::cos(5 * t)), a = 20 * std::cos(5 * t);
    CHECK(at.read("joints/foot/drive_force")[0] ==
          Approx((J + m * l * l) * a + m * g * l * std::cos(phi)).margin(1e-9));
  });
  compute_kinematics(session, {.duration = 2, .step = 0.05});
}

TEST_CASE("forward dynamics under the torque of inverse dynamics moves as that was told") {
  const std::string torque =
      fmt::format("torque: \"{:.17g}*20*cos(5*t) + {:.17g}*cos(0.8*(1 - cos(5*t)))\"", J + m * l * l, m * g * l);
  check_second_order(
      [&](double h) {
        const MechanismFile file = read_mechanism_text(pendulum(torque), "model.yaml");
        Session session(file.model);
        DynamicsOptions options;
        options.duration = 1;
        options.stepping.size = h;
        session.dynamics(options).finish();
        return Eigen::VectorXd::Constant(1, session.read("joints/foot/coordinate")[0] - 0.8 * (1 - std::cos(5.0)));
      },
      4e-3, 3);
}

TEST_CASE("inverse dynamics meets stops") {
  // The stop has 1000 N m/rad from 0.5 rad on; the arm stands at 1 rad in the end.
  std::string text = pendulum("angle: \"step(t, 0, 1)\"");
  text.replace(text.find("axis: [0, -1, 0]"), 16, "axis: [0, -1, 0], stops: {range: [~, 0.5], stiffness: 1000}");
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_kinematics(session, {.duration = 1, .step = 0.05});
  CHECK(session.read("joints/foot/drive_force")[0] == Approx(500 + m * g * l * std::cos(1.0)).epsilon(1e-9));
}

TEST_CASE("kinematics does not change its branch at a dead centre without a word") {
  // A parallelogram whose links are in line after half a turn: some steps end exactly there, others do not.
  const std::string text =
      "nodes: {a: {position: [0, 0.5, 0]}, b: {position: [1, 1, 0]}, c: {position: [2, 0.5, 0]}}\njoints:\n"
      "  d: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 0, 1]}\n"
      "  e: {type: hinge, nodes: [a, b], position: [0, 1, 0], axis: [0, 0, 1]}\n"
      "  f: {type: hinge, nodes: [b, c], position: [2, 1, 0], axis: [0, 0, 1]}\n"
      "  g: {type: hinge, nodes: [c, ground], position: [2, 0, 0], axis: [0, 0, 1]}\n"
      "drives: {m: {joint: d, angle: \"t\"}}\n";
  const double pi = std::acos(-1.0);
  for (const double step : {pi / 8, 0.1}) {
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    bool right = true;
    session.on_step([&](Session& at) {
      const Vector3 x = at.node("b").x, exact(1 - std::sin(at.time()), std::cos(at.time()), 0);
      right = right && (x - exact).norm() < 1e-9;
    });
    const std::string said =
        message_of<std::runtime_error>([&] { compute_kinematics(session, {.duration = 2 * pi, .step = step}); });
    CAPTURE(step, said);
    CHECK(right);
    if (step == 0.1) CHECK(said == "(nothing thrown)");
  }
}

TEST_CASE("kinematics goes on where a drive changes its speed at once") {
  // The speed jumps between two steps, and jumps back at the end of one.
  const MechanismFile file = read_mechanism_text(
      slider_crank(bodies, "drives: {motor: {joint: main, angle: \"3*t + 40*ramp(t, 0.113, 1.113)\"}}\n"),
      "model.yaml");
  Session session(file.model);
  bool right = true;
  session.on_step([&](Session& at) {
    const double t = at.time(), angle = 3 * t + 40 * std::clamp(t - 0.113, 0.0, 1.0), s = std::sin(angle);
    right = right && std::abs(at.node("piston").x[0] - 0.1 * std::cos(angle) - std::sqrt(0.04 - 0.01 * s * s)) < 1e-12;
  });
  CHECK(compute_kinematics(session, {.duration = 1.5, .step = 0.02}).points ==
        78);  // 76 steps of the grid and two kinks between them
  CHECK(right);
}

TEST_CASE("rows of kinematics stand at the times that the output asks for") {
  const MechanismFile file = read_mechanism_text(
      slider_crank(bodies, driven) +
          "analysis: [{type: kinematic, duration: 1, step: 0.02}]\noutput: {times: [0.04, 0.1234, 1]}\n",
      "model.yaml");
  Session session(file.model);
  MemorySink memory(session.model());
  session.add_sink(memory);
  session.set_recording(file.output.recording);
  session.begin_analysis("kinematic");
  compute_kinematics(session, {.duration = 1, .step = 0.02});
  session.end_analysis();
  const std::vector<double> time = memory.read(0, "time"), angle = memory.read(0, "joints/main/coordinate");
  CHECK_THAT(time, Catch::Approx(std::vector<double>{0, 0.04, 0.1234, 1}));
  for (std::size_t i = 0; i < time.size(); ++i)
    CHECK(angle[i] == Approx(30 * time[i] + 0.5 * std::sin(7 * time[i])).margin(1e-12));
}

TEST_CASE("kinematics asks for what is not driven") {
  const MechanismFile free = read_mechanism_text(slider_crank(bodies, ""), "model.yaml");
  Session loose(free.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_kinematics(loose, {.duration = 1, .step = 0.1}); }),
             Contains("1 degree of freedom is not driven") && Contains("dynamic analysis"));
  const MechanismFile rate =
      read_mechanism_text(slider_crank(bodies, "drives: {motor: {joint: main, rate: \"5\"}}\n"), "model.yaml");
  Session turning(rate.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_kinematics(turning, {.duration = 1, .step = 0.1}); }),
             Contains("condition on velocities"));
  const MechanismFile filter = read_mechanism_text(
      slider_crank(bodies, driven + "states: {slow: {rate: \"main.angle - slow\", start: 0}}\n"), "model.yaml");
  Session filtered(filter.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_kinematics(filtered, {.duration = 1, .step = 0.1}); }),
             Contains("motion of its own"));
  // The connecting rod is too short, so that the crank cannot turn beyond an angle.
  const MechanismFile stuck = read_mechanism_text(
      "nodes: {crank: {position: [0.1, 0, 0]}, rod: {position: [0.13, 0, 0]}}\n"
      "joints:\n  main: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 0, 1]}\n"
      "  pin: {type: hinge, nodes: [crank, rod], position: [0.1, 0, 0], axis: [0, 0, 1]}\n"
      "  wrist: {type: point_on_line, nodes: [ground, rod], at: [[0, 0, 0], [0.03, 0, 0]], line: [1, 0, 0]}\n"
      "drives: {motor: {joint: main, angle: \"t\"}}\n",
      "model.yaml");
  Session blocked(stuck.model);
  const std::string said =
      message_of<std::runtime_error>([&] { compute_kinematics(blocked, {.duration = 3, .step = 0.1}); });
  CHECK_THAT(said, Contains("t = 0.7 s: ") && Contains("drive 'motor' stays 3.2"));
}

}  // namespace test_kinematics
