// Inverse dynamics of machines whose tool follows a prescribed path: the torques and forces of joints that cause it,
// against closed forms and against the same motion made by drives.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/benchmarks/driven/delta_robot.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using Catch::Contains;

namespace test_sought_efforts {
namespace {

constexpr double g = 9.81;

/// A robot arm of two links in the plane x, y, drawn with the angles q1 and q2 (of the second link relative to the
/// first). The node `tip` is that of the second body.
struct Arm {
  double l1 = 0.5, l2 = 0.4, m1 = 3, m2 = 2, J1 = 0.07, J2 = 0.03;
  double q1 = 0.3, q2 = 1.1;  // [rad]

  double tip_x(double a, double b) const { return l1 * std::cos(a) + l2 * std::cos(a + b); }
  double tip_y(double a, double b) const { return l1 * std::sin(a) + l2 * std::sin(a + b); }

  /// @param tip  keys of the tip's node @param rest  sections of the drives, keys of the joints
  std::string model(const std::string& tip, const std::string& rest, const std::string& of_elbow = "") const {
    const double x1 = l1 * std::cos(q1), y1 = l1 * std::sin(q1), x2 = tip_x(q1, q2), y2 = tip_y(q1, q2);
    return fmt::format(
        "gravity: [0, -9.81, 0]\nnodes:\n  upper: {{position: [{:.17g}, {:.17g}, 0]}}\n"
        "  tip: {{position: [{:.17g}, {:.17g}, 0]{}}}\n"
        "elements:\n  upper: {{type: rigid_body, node: upper, mass: {}, inertia: [0.1, 0.1, {}]}}\n"
        "  lower: {{type: rigid_body, node: tip, mass: {}, centre: [{:.17g}, {:.17g}, 0], inertia: [0.1, 0.1, {}]}}\n"
        "joints:\n  shoulder: {{type: hinge, nodes: [ground, upper], position: [0, 0, 0], axis: [0, 0, 1]}}\n"
        "  elbow: {{type: hinge, nodes: [upper, tip], position: [{:.17g}, {:.17g}, 0], axis: [0, 0, 1]{}}}\n{}",
        x1 / 2, y1 / 2, x2, y2, tip, m1, J1, m2, (x1 - x2) / 2, (y1 - y2) / 2, J2, x1, y1, of_elbow, rest);
  }

  /// Returns the torques M(q) q'' + c(q, q') + g(q) of the textbook for a tip at p with velocity v and acceleration a.
  struct Torques {
    double shoulder, elbow;
  };
  Torques torques(const Eigen::Vector2d& p, const Eigen::Vector2d& v, const Eigen::Vector2d& a) const {
    const double c = (p.squaredNorm() - l1 * l1 - l2 * l2) / (2 * l1 * l2), b = std::acos(c);  // the elbow as drawn
    const double alpha = std::atan2(p[1], p[0]) - std::atan2(l2 * std::sin(b), l1 + l2 * c), beta = alpha + b;
    Eigen::Matrix2d J, Jdot;
    J << -l1 * std::sin(alpha) - l2 * std::sin(beta), -l2 * std::sin(beta), l1 * std::cos(alpha) + l2 * std::cos(beta),
        l2 * std::cos(beta);
    const Eigen::Matrix2d inverse = J.inverse();
    const Eigen::Vector2d rate = inverse * v;
    const double w1 = rate[0], w2 = rate[0] + rate[1];
    Jdot << -l1 * std::cos(alpha) * w1 - l2 * std::cos(beta) * w2, -l2 * std::cos(beta) * w2,
        -l1 * std::sin(alpha) * w1 - l2 * std::sin(beta) * w2, -l2 * std::sin(beta) * w2;
    const Eigen::Vector2d second = inverse * (a - Jdot * rate);
    const double lc1 = l1 / 2, lc2 = l2 / 2, k = m2 * l1 * lc2;
    const double M12 = J2 + m2 * lc2 * lc2 + k * std::cos(b), M22 = J2 + m2 * lc2 * lc2;
    const double M11 = J1 + m1 * lc1 * lc1 + m2 * l1 * l1 + M12 + k * std::cos(b);
    const double g2 = m2 * lc2 * g * std::cos(beta), g1 = (m1 * lc1 + m2 * l1) * g * std::cos(alpha) + g2;
    const double s = k * std::sin(b);
    return {M11 * second[0] + M12 * second[1] - s * (2 * rate[0] * rate[1] + rate[1] * rate[1]) + g1,
            M12 * second[0] + M22 * second[1] + s * rate[0] * rate[0] + g2};
  }
};

const char* const sought_arm =
    "drives:\n  shoulder: {joint: shoulder, torque: sought}\n  elbow: {joint: elbow, torque: sought}\n";

double force_of(Session& session, const std::string& joint) {
  return session.read("joints/" + joint + "/drive_force")[0];
}

}  // namespace

TEST_CASE("the torques of a robot arm whose tip follows a straight line are those of the textbook") {
  // The tip oscillates along a line: x = -A (1 - cos(w t)), y = B (1 - cos(w t)).
  const Arm arm;
  const double A = 0.15, B = 0.1, w = 5;
  const MechanismFile file = read_mechanism_text(
      arm.model(fmt::format(", motion: {{x: \"-{0}*(1 - cos({2}*t))\", y: \"{1}*(1 - cos({2}*t))\"}}", A, B, w),
                sought_arm),
      "arm.yaml");
  for (const bool elastic : {false, true}) {
    Session session(file.model);
    const Eigen::Vector2d start(arm.tip_x(arm.q1, arm.q2), arm.tip_y(arm.q1, arm.q2)), line(-A, B);
    long looked = 0;
    double missing = 0, exchanged = 0;
    session.on_step([&](Session& at) {
      const double t = at.time(), c = std::cos(w * t), s = std::sin(w * t);
      const Arm::Torques expected = arm.torques(start + (1 - c) * line, w * s * line, w * w * c * line);
      CHECK(force_of(at, "shoulder") == Approx(expected.shoulder).epsilon(1e-9).margin(1e-9));
      CHECK(force_of(at, "elbow") == Approx(expected.elbow).epsilon(1e-9).margin(1e-9));
      const std::vector<double> support = at.read("supports/tip/reaction");
      CHECK(std::abs(support[0]) + std::abs(support[1]) < 1e-8);
      missing = std::max(missing, std::abs(at.balance()));
      exchanged = std::max(exchanged, at.energy().kinetic);
      ++looked;
    });
    compute_kinematics(session, {.duration = 1.3, .step = 0.01, .elastic = elastic});
    CHECK(looked == 130);
    // The trapezoidal rule has an error of (h w)^2/12 of each oscillation of the power, whose second harmonics have the
    // frequency 2 w.
    CHECK(exchanged > 0.5);
    CHECK(missing < 3e-3 * exchanged);
  }
}

TEST_CASE("the sought torques are those of drives that make the same motion, with friction in the joints") {
  const Arm arm;
  const std::string q1 = "0.6*(1 - cos(3*t))", q2 = "(0.2*sin(4*t)^2)";
  const std::string friction = ", friction: {coefficient: 0.2, radius: 0.05, velocity: 1e-3}";
  const auto run = [&](const std::string& text) {
    const MechanismFile file = read_mechanism_text(text, "arm.yaml");
    Session session(file.model);
    std::vector<double> torques;
    session.on_step([&](Session& at) {
      torques.push_back(force_of(at, "shoulder"));
      torques.push_back(force_of(at, "elbow"));
    });
    compute_kinematics(session, {.duration = 0.8, .step = 0.01});
    return torques;
  };
  for (const std::string& of_elbow : {std::string(), friction}) {
    const std::vector<double> driven =
        run(arm.model("",
                      fmt::format("drives:\n  shoulder: {{joint: shoulder, angle: \"{}\"}}\n"
                                  "  elbow: {{joint: elbow, angle: \"{}\"}}\n",
                                  q1, q2),
                      of_elbow));
    const std::string a = fmt::format("({:.17g} + {})", arm.q1, q1),
                      b = fmt::format("({} + {:.17g} + {})", a, arm.q2, q2);
    const std::vector<double> sought = run(arm.model(
        fmt::format(", motion: {{x: \"{0}*cos({2}) + {1}*cos({3}) - {4:.17g}\", y: \"{0}*sin({2}) + {1}*sin({3}) - "
                    "{5:.17g}\"}}",
                    arm.l1, arm.l2, a, b, arm.tip_x(arm.q1, arm.q2), arm.tip_y(arm.q1, arm.q2)),
        sought_arm, of_elbow));
    REQUIRE(sought.size() == driven.size());
    for (std::size_t k = 0; k < sought.size(); ++k) CHECK(sought[k] == Approx(driven[k]).epsilon(1e-8).margin(1e-8));
  }
}

TEST_CASE("the force that moves a mass through a spring is found, and so is where its joint has to be") {
  // A slide of mass ma pulls the mass mb by a spring k; mb follows x(t), gravity acts against it. In equilibrium with
  // the inertia of mb the spring is longer by mb (x'' + g)/k, and the force is (ma + mb) (x'' + g). The slide's
  // acceleration is taken to be that of mb: the difference is a term in x''''.
  const double ma = 0.7, mb = 2, k = 4e4, A = 0.1, w = 6;
  const auto model = [&](const std::string& mass, const std::string& drive) {
    return fmt::format(
        "gravity: [-9.81, 0, 0]\nnodes: {{a: {{position: [1, 0, 0]}}, b: {{position: [0.5, 0, 0]{}}}}}\n"
        "elements:\n  a: {{type: rigid_body, node: a, mass: {}, inertia: [0.1, 0.1, 0.1]}}\n"
        "  b: {{type: rigid_body, node: b, mass: {}, inertia: [0.1, 0.1, 0.1]}}\n"
        "  spring: {{type: spring_damper, nodes: [a, b], stiffness: {}}}\n"
        "joints:\n  rail_a: {{type: prismatic, nodes: [ground, a], position: [1, 0, 0], axis: [1, 0, 0]}}\n"
        "  rail_b: {{type: prismatic, nodes: [ground, b], position: [0.5, 0, 0], axis: [1, 0, 0]}}\n"
        "drives: {{motor: {{joint: rail_a, {}}}}}\n",
        mass, ma, mb, k, drive);
  };
  const MechanismFile file = read_mechanism_text(
      model(fmt::format(", motion: {{x: \"{}*(1 - cos({}*t))\"}}", A, w), "force: sought"), "slide.yaml");
  Session session(file.model);
  std::vector<double> forces;
  double missing = 0;
  session.on_step([&](Session& at) {
    const double t = at.time(), x = A * (1 - std::cos(w * t)), second = A * w * w * std::cos(w * t);
    CHECK(force_of(at, "rail_a") == Approx((ma + mb) * (second + g)).epsilon(1e-8));
    CHECK(at.node("a").x[0] == Approx(1 + x + mb * (second + g) / k).epsilon(1e-9));
    forces.push_back(force_of(at, "rail_a"));
    missing = std::max(missing, std::abs(at.balance()));
  });
  compute_kinematics(session, {.duration = 1, .step = 0.01, .elastic = true});
  // The error is the power of the spring's force along the change of its length by inertia; the rest is the trapezoidal
  // rule's (h w)^2/12.
  const double by_inertia = 2 * mb * A * w * w / k, kinetic = 0.5 * (ma + mb) * A * A * w * w;
  CHECK(missing < by_inertia * mb * (A * w * w + g) + std::pow(0.01 * w, 2) / 12 * kinetic);
  // A drive that moves the slide in the same way needs the same force, except for the term in x''''.
  const MechanismFile driven = read_mechanism_text(
      model("", fmt::format("displacement: \"{0}*(1 - cos({1}*t)) + {2:.17g}*({0}*{1}^2*cos({1}*t) + {3})\"", A, w,
                            mb / k, g)),
      "slide.yaml");
  Session again(driven.model);
  std::size_t row = 0;
  again.on_step([&](Session& at) {
    CHECK(force_of(at, "rail_a") == Approx(forces[row++]).margin(1.5 * w * w / (k / mb) * (ma + mb) * A * w * w));
  });
  compute_kinematics(again, {.duration = 1, .step = 0.01, .elastic = true});
}

TEST_CASE("torques about a spherical joint turn a body as its rotation vector is prescribed") {
  // The inertia about the node is J: the torque is J dOmega/dt + Omega x J Omega, and its power is that of the kinetic
  // energy.
  const MechanismFile file = read_mechanism_text(
      "nodes: {b: {motion: {rx: \"0.4*sin(2*t)\", ry: \"0.5*t\", rz: \"0.3*(1 - cos(3*t))\"}}}\n"
      "elements: {b: {type: rigid_body, node: b, mass: 1, inertia: [0.2, 0.3, 0.4]}}\n"
      "joints: {ball: {type: spherical, nodes: [ground, b], position: [0, 0, 0]}}\n"
      "drives:\n  one: {joint: ball, coordinate: rx, torque: sought}\n"
      "  two: {joint: ball, coordinate: ry, torque: sought}\n  three: {joint: ball, coordinate: rz, torque: sought}\n",
      "ball.yaml");
  Session session(file.model);
  const Vector3 J(0.2, 0.3, 0.4);
  session.on_step([&](Session& at) {
    const NodeState& node = at.node("b");
    const Vector3 expected = J.cwiseProduct(node.Omegadot) + node.Omega.cross(J.cwiseProduct(node.Omega));
    const std::vector<double> torque = at.read("joints/ball/drive_force");
    CHECK(Vector3(torque[0], torque[1], torque[2]).norm() == Approx(expected.norm()).epsilon(1e-9));
    const std::vector<double> support = at.read("supports/b/reaction");
    CHECK(std::abs(support[3]) + std::abs(support[4]) + std::abs(support[5]) < 1e-9);
  });
  const KinematicsReport report = compute_kinematics(session, {.duration = 1, .step = 0.002});
  CHECK(report.points == 501);
  CHECK(std::abs(report.balance) < 1e-5);
}

TEST_CASE("the force on a slider that turns its crank is found, but not through the dead centre") {
  // Massless rod, crank of inertia J: F dx/da = J a'' with x = r cos a + sqrt(l^2 - r^2 sin^2 a). The crank's node is
  // fixed but for its rotation.
  const double r = 0.1, l = 0.3, J = 0.2;
  const auto slide_crank = [&](const std::string& angle, double start) {
    const double x = r * std::cos(start), y = r * std::sin(start), end = x + std::sqrt(l * l - y * y);
    return fmt::format(
        "nodes:\n  c: {{fixed: [x, y, z, rx, ry], motion: {{rz: \"{0}\"}}}}\n"
        "  d: {{position: [{1:.17g}, {2:.17g}, 0]}}\n  p: {{position: [{3:.17g}, 0, 0]}}\n"
        "elements:\n  c: {{type: rigid_body, node: c, mass: 1, inertia: [0.2, 0.2, {4}]}}\n"
        "  d: {{type: rigid_body, node: d, mass: 1e-9, inertia: [1e-9, 1e-9, 1e-9]}}\n"
        "joints:\n  pin: {{type: hinge, nodes: [c, d], position: [{1:.17g}, {2:.17g}, 0], axis: [0, 0, 1]}}\n"
        "  gud: {{type: hinge, nodes: [d, p], position: [{3:.17g}, 0, 0], axis: [0, 0, 1]}}\n"
        "  sl: {{type: prismatic, nodes: [ground, p], position: [{3:.17g}, 0, 0], axis: [1, 0, 0]}}\n"
        "drives: {{push: {{joint: sl, force: sought}}}}\n",
        angle, x, y, end, J);
  };
  const MechanismFile file = read_mechanism_text(slide_crank("0.5*t^2", 0.5), "crank.yaml");
  Session session(file.model);
  session.on_step([&](Session& at) {
    const double a = 0.5 + 0.5 * at.time() * at.time(), s = r * std::sin(a);
    const double slope = -s - s * r * std::cos(a) / std::sqrt(l * l - s * s);
    CHECK(force_of(at, "sl") == Approx(J / slope).epsilon(1e-6));
  });
  CHECK(compute_kinematics(session, {.duration = 1.5, .step = 0.05}).points == 31);
  // If the links are in line, the slider's force has no arm.
  const MechanismFile in_line = read_mechanism_text(slide_crank("t", 0), "crank.yaml");
  Session refused(in_line.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_kinematics(refused, {.duration = 1, .step = 0.1}); }),
             Contains("t = 0 s: the force on displacement of joint 'sl' moves nothing that has a `motion`"));
}

TEST_CASE("a delta robot's motors lift its platform as they would if they were driven") {
  using namespace bielle::test;
  // Arms by theta lower the elbows by a sin(theta): z = a sin(theta) + sqrt(rod^2 - (base + a cos(theta) -
  // platform)^2).
  const std::string theta = "0.5*step(t, 0.05, 0.3)";
  const std::string depth = fmt::format("{0}*sin({1}) + sqrt({2}^2 - ({3} + {0}*cos({1}))^2)", delta_arm, theta,
                                        delta_rod, delta_base - delta_platform);
  const auto run = [&](bool sought, double stiffer, double& missing) {
    std::string text = delta_robot(stiffer);
    if (sought) {
      text.replace(text.find("platform: {position: [0, 0, "), 11,
                   fmt::format("platform: {{motion: {{x: 0, y: 0, z: \"{:.17g} - ({})\"}}, ", delta_depth(), depth));
      text = text.substr(0, text.find("drives:")) + "drives:\n";
      for (int k = 1; k <= 3; ++k) text += fmt::format("  motor_{0}: {{joint: motor_{0}, torque: sought}}\n", k);
    }
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    std::vector<double> torques;
    missing = 0;
    session.on_step([&](Session& at) {
      torques.push_back(at.read("joints/motor_1/drive_force")[0]);
      CHECK(at.read("joints/motor_2/drive_force")[0] == Approx(torques.back()).epsilon(1e-6).margin(1e-6));
      missing = std::max(missing, std::abs(at.balance()));
    });
    compute_kinematics(session, {.duration = 0.35, .step = 5e-3, .elastic = true});
    return torques;
  };
  double missing = 0, unused = 0;
  const std::vector<double> driven = run(false, 1e4, unused), sought = run(true, 1e4, missing),
                            elastic = run(true, 1, unused);
  REQUIRE(driven.size() == sought.size());
  CHECK(missing < 5e-3);  // (h w)^2/12 of some 1 J
  for (std::size_t k = 0; k < driven.size(); ++k) {
    CHECK(sought[k] == Approx(driven[k]).epsilon(1e-4).margin(1e-3));
    CHECK(elastic[k] == Approx(driven[k]).margin(0.05));
  }
  CHECK(sought.front() == Approx(delta_torque_at_rest()).epsilon(1e-6));
}

TEST_CASE("efforts that cannot be sought are refused, with the reason") {
  const Arm arm;
  const auto refusal = [](const std::string& text) {
    return message_of<std::runtime_error>([&] {
      const MechanismFile file = read_mechanism_text(text, "arm.yaml");
      Session session(file.model);
      compute_kinematics(session, {.duration = 0.2, .step = 0.1});
    });
  };
  const std::string moved = ", motion: {x: \"-0.1*t\", y: \"0.1*t\"}";
  CHECK_THAT(
      refusal(arm.model(", motion: {x: \"-0.1*t\", y: \"0.1*t\"}", "drives: {s: {joint: shoulder, torque: sought}}\n")),
      Contains("1 effort is sought") && Contains("2 directions are prescribed") && Contains("x of node 'tip'"));
  CHECK_THAT(refusal(arm.model("", "drives: {s: {joint: shoulder, torque: sought}}\n")),
             Contains("0 directions are prescribed"));
  CHECK_THAT(refusal(arm.model(moved, "drives: {s: {joint: shoulder, torque: sought, limit: 3}}\n")),
             Contains("arm.yaml:") && Contains("does not go with an effort that is sought"));
  CHECK_THAT(refusal(arm.model(moved, "drives: {s: {joint: shoulder, torque: sought, moves: upper}}\n")),
             Contains("node 'upper' has no `motion`"));
  CHECK_THAT(refusal(arm.model(moved, "drives: {s: {joint: shoulder, torque: 3, moves: tip}}\n")),
             Contains("belongs to a `torque` or `force` that is `sought`"));
  CHECK_THAT(refusal(arm.model(moved, sought_arm, ", locked: {to: 1}")), Contains("leaves no effort to be sought"));
  CHECK_THAT(refusal(arm.model(moved, std::string(sought_arm) + "  more: {joint: elbow, angle: 0}\n")),
             Contains("driven by 'elbow' already"));
  // A hinge on a held part moves no node, and a wheel that is geared to the shoulder moves only with the shoulder.
  const auto with = [&](const std::string& node, const std::string& joints, const std::string& second) {
    std::string text = arm.model(moved, fmt::format("drives:\n  s: {{joint: shoulder, torque: sought}}\n"
                                                    "  e: {{joint: {}, torque: sought}}\n",
                                                    second));
    text.insert(text.find("  tip:"), node);
    return text.insert(text.find("  elbow: {type"), joints);
  };
  CHECK_THAT(refusal(with("  post: {position: [1, 1, 0], fixed: true}\n",
                          "  idle: {type: hinge, nodes: [ground, post], axis: [0, 0, 1]}\n", "idle")),
             Contains("t = 0 s: the torque on angle of joint 'idle' moves nothing that has a `motion`"));
  CHECK_THAT(refusal(with("  wheel: {position: [1, 1, 0]}\n",
                          "  axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}\n"
                          "  gear: {type: gear, joints: [shoulder, axle], ratio: -2}\n",
                          "axle")),
             Contains("do not move x of node 'tip', y of node 'tip' independently of each other"));
  const MechanismFile file = read_mechanism_text(arm.model(moved, sought_arm), "arm.yaml");
  Session session(file.model);
  CHECK_THAT(message_of<std::runtime_error>([&] { compute_statics(session); }),
             Contains("a static analysis cannot seek the torque on angle of joint 'shoulder'"));
  DynamicsOptions options;
  options.duration = 1;
  options.stepping.size = 0.1;
  CHECK_THAT(message_of<std::runtime_error>([&] { session.dynamics(options); }),
             Contains("a dynamic analysis cannot seek"));
}

}  // namespace test_sought_efforts
