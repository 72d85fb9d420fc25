// PID controllers against the equations of their closed loops, between limits and at them.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/hinged_rotor.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random.hpp"
#include "tests/support/runge_kutta.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::advance_by_runge_kutta;
using bielle::test::check_second_order;
using bielle::test::rotor;
using Catch::Contains;
using Vector5 = Eigen::Matrix<double, 5, 1>;

namespace {

constexpr double inertia = 0.5;

struct End {
  double angle, rate, torque;
};

End run(const std::string& text, double duration, double h, double tolerance = 0, DynamicsOptions options = {}) {
  Session session(read_mechanism_text(text, "model.yaml").model);
  options.duration = duration;
  options.stepping.size = h;
  options.stepping.tolerance = tolerance;
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  return {session.read("joints/main/coordinate")[0], session.read("joints/main/rate")[0],
          session.read("joints/main/drive_force")[0]};
}

/// The closed loop with all features of a controller. z: angle, rate, integral, filtered error, time.
struct ClosedLoop {
  double kp, ki, kd, filter, limit, tracking;
  double (*target)(double);
  double (*target_rate)(double);
  Vector5 z = Vector5::Zero();

  double effort(const Vector5& at) const {
    const double e = target(at[4]) - at[0];
    const double D = filter > 0 ? (e - at[3]) / filter : target_rate(at[4]) - at[1];
    return kp * e + ki * at[2] + kd * D;
  }
  double torque(const Vector5& at) const { return std::clamp(effort(at), -limit, limit); }
  Vector5 rate(const Vector5& at) const {
    const double e = target(at[4]) - at[0], Q = torque(at);
    const double windup = Q == effort(at) ? 0 : (Q - effort(at)) / (ki * tracking);
    Vector5 dz;
    dz << at[1], Q / inertia, e + windup, filter > 0 ? (e - at[3]) / filter : 0, 1;
    return dz;
  }
  void advance(double duration, int steps) {
    z[3] = target(z[4]) - z[0];
    advance_by_runge_kutta(z, duration, steps, [this](const Vector5& at) { return rate(at); });
  }
};

constexpr double none = 1e30;

}  // namespace

TEST_CASE("a PID controller moves a hinge as its closed loop, with a filter of the derivative and without") {
  for (const double filter : {0.0, 0.02}) {
    CAPTURE(filter);
    ClosedLoop loop{60,
                    90,
                    6,
                    filter,
                    none,
                    1,
                    [](double t) { return 0.5 + std::sin(3 * t); },
                    [](double t) { return 3 * std::cos(3 * t); }};
    loop.advance(0.8, 20000);
    const std::string text =
        rotor("drives: {motor: {joint: main, pid: {target: \"0.5 + sin(3*t)\", kp: 60, ki: 90, kd: 6" +
              std::string(filter > 0 ? ", filter: 0.02" : "") + "}}}\n");
    DynamicsOptions stabilised, newmark;
    stabilised.form = ConstraintForm::stabilised;
    newmark.scheme = Scheme::newmark();
    for (const DynamicsOptions& options : {DynamicsOptions(), stabilised, newmark})
      check_second_order(
          [&](double h) {
            const End end = run(text, 0.8, h, 0, options);
            return Eigen::Vector3d(end.angle - loop.z[0], (end.rate - loop.z[1]) / 10,
                                   (end.torque - loop.torque(loop.z)) / 60);
          },
          0.005, 4);
  }
}

TEST_CASE("at a limit the torque stays there, and the integral follows it") {
  // A step of 1 rad requires ten times the available torque.
  ClosedLoop loop{60, 90, 6, 0, 5, 60.0 / 90, [](double) { return 1.0; }, [](double) { return 0.0; }};
  ClosedLoop slow = loop;
  const double end = 1.2;
  // The right side has kinks: the reference is of second order there, with steps of 3 us.
  loop.advance(end, 400000);
  const std::string pid = "drives: {motor: {joint: main, pid: {target: 1, kp: 60, ki: 90, kd: 6, limit: 5";
  // The place in a step at which a limit is met makes errors scatter by a factor of two: the worst of several sizes of
  // steps is compared with the worst of steps an eighth as long. Two in three halvings are 0.3 in the order.
  const auto worst = [&](double part) {
    double most = 0;
    for (const double h : {0.01, 0.0091, 0.0083, 0.0076, 0.0069, 0.0063}) {
      const End found = run(rotor(pid + "}}}\n"), end, part * h);
      most = std::max(most, std::abs(found.angle - loop.z[0]) + std::abs(found.rate - loop.z[1]) / 10);
    }
    return most;
  };
  const double coarse = worst(1), fine = worst(0.125);
  INFO(coarse << " -> " << fine);
  CHECK(std::log2(coarse / fine) / 3 == Approx(2).margin(0.35));
  const End adaptive = run(rotor(pid + "}}}\n"), end, 1e-4, 1e-8);
  CHECK(std::abs(adaptive.angle - loop.z[0]) < std::pow(1e-8, 2.0 / 3));
  // Another tracking time gives another motion, which is also correct.
  slow.tracking = 3;
  slow.advance(end, 400000);
  CHECK(std::abs(slow.z[0] - loop.z[0]) > 1e-3);
  const End other = run(rotor(pid + ", tracking_time: 3}}}\n"), end, 1e-4, 1e-8);
  CHECK(std::abs(other.angle - slow.z[0]) < std::pow(1e-8, 2.0 / 3));
}

TEST_CASE("a torque drive within limits is cut off there") {
  // 3 + 10 t up to 5 N m at 0.2 s, then 5.
  const std::string text = rotor("drives: {motor: {joint: main, torque: \"3 + 10*t\", limit: [-1, 5]}}\n");
  const double t = 0.5, s = 0.2, w = (3 * s + 5 * s * s) / inertia,
               angle = (1.5 * s * s + 10.0 / 6 * s * s * s) / inertia;
  check_second_order(
      [&](double h) {
        const End end = run(text, t, h);
        CHECK(end.torque == 5);
        return Eigen::Vector2d(end.angle - (angle + w * (t - s) + 5 / inertia * (t - s) * (t - s) / 2),
                               end.rate - (w + 5 / inertia * (t - s)));
      },
      0.02, 3);
}

TEST_CASE("what starts beyond its limit starts at it") {
  const End end = run(rotor("drives: {motor: {joint: main, torque: 7, limit: 2}}\n"), 0.5, 0.05);
  CHECK(end.rate == Approx(2 / inertia * 0.5).epsilon(1e-11));
  const End below = run(rotor("drives: {motor: {joint: main, torque: -7, limit: [~, 2]}}\n"), 0.5, 0.05);
  CHECK(below.rate == Approx(-7 / inertia * 0.5).epsilon(1e-11));
}

TEST_CASE("tangents beyond a limit are derivatives, too") {
  for (const std::string limit : {"[1e3, 2e3]", "[-2e3, -1e3]"}) {
    CAPTURE(limit);
    const MechanismFile file = read_mechanism_text(R"yaml(
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}
joints: {axle: {type: hinge, nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3]}}
drives: {it: {joint: axle, pid: {target: "axle.angle.rate*t", kp: 3, ki: 2, kd: 0.5, filter: 0.3, limit: )yaml" +
                                                       limit + "}}}\n",
                                                   "model.yaml");
    const test::DenseModel model(file.model, 1);
    State state = model.start();
    test::Random random(3);
    model.move(state, 0.3 * random.vector(model.size()));
    model.move_rates(state, random.vector(model.size()));
    state.time = 0.7;
    const auto check = [&](test::DenseModel::Part part, void (test::DenseModel::*move)(State&, const VectorX&) const) {
      const MatrixX expected = test::jacobian(
          [&](const VectorX& step) {
            State moved = state;
            (model.*move)(moved, step);
            return model.residual(moved);
          },
          model.size());
      CHECK((model.tangent(state, part) - expected).cwiseAbs().maxCoeff() < 1e-10 * expected.cwiseAbs().maxCoeff());
    };
    check(test::DenseModel::Part::K, &test::DenseModel::move);
    check(test::DenseModel::Part::C, &test::DenseModel::move_rates);
  }
}

TEST_CASE("a stiff controller at its limits again and again goes on") {
  // Velocities reach and leave limits dozens of times.
  const End end = run(R"yaml(
gravity: [0, -9.81, 0]
nodes: {arm: {position: [0.5, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1]}}
drives: {motor: {joint: main, pid: {target: "0.2*sin(20*t)", kp: 1e5, ki: 1e5, kd: 2e3, limit: 20}}}
)yaml",
                      3, 0.002);
  CHECK(std::abs(end.torque) <= 20);
  CHECK(std::abs(end.angle) < 2);
}

TEST_CASE("a controller may act on one coordinate to bring about something else") {
  // A screw: the motor turns a rotor, a filter measures its angle, and the filter's output is controlled.
  const std::string text = rotor(R"yaml(
states: {seen: {filter: "0.2*main.angle", time_constant: 0.05}}
drives: {motor: {joint: main, pid: {measure: seen, target: "0.1*t", kp: 100, kd: 30, filter: 0.01}}}
)yaml");
  Vector5 z = Vector5::Zero();  // angle, rate, seen, filtered error, time
  const auto rate = [](const Vector5& at) {
    const double e = 0.1 * at[4] - at[2], D = (e - at[3]) / 0.01;
    Vector5 dz;
    dz << at[1], (100 * e + 30 * D) / inertia, (0.2 * at[0] - at[2]) / 0.05, D, 1;
    return dz;
  };
  advance_by_runge_kutta(z, 0.6, 20000, rate);
  check_second_order(
      [&](double h) {
        const End end = run(text, 0.6, h);
        return Eigen::Vector2d(end.angle - z[0], (end.rate - z[1]) / 10);
      },
      0.004, 4);
}

TEST_CASE("in statics a PID controller without limits reaches its target, and one at its limit gives what it has") {
  const auto settled = [](const std::string& limit) {
    Session session(read_mechanism_text(R"yaml(
gravity: [0, -9.81, 0]
nodes: {arm: {position: [0.5, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1], stiffness: 4}}
drives: {motor: {joint: main, pid: {target: 0.4, kp: 20, ki: 30, kd: 2)yaml" +
                                            limit + "}}}\n",
                                        "model.yaml")
                        .model);
    compute_statics(session, {});
    return std::pair(session.read("joints/main/coordinate")[0], session.read("joints/main/drive_force")[0]);
  };
  const auto [angle, torque] = settled("");
  CHECK(angle == Approx(0.4).epsilon(1e-9));
  CHECK(torque == Approx(2 * 9.81 * 0.5 * std::cos(0.4) + 4 * 0.4).epsilon(1e-8));
  const auto [low, most] = settled(", limit: 6");
  CHECK(most == 6);
  CHECK(4 * low == Approx(6 - 2 * 9.81 * 0.5 * std::cos(low)).epsilon(1e-8));
}

TEST_CASE(
    "in statics a controller reaches a target from where its torque is at the limit, whatever else holds the joint") {
  for (const std::string limit : {"15", "[~, 15]"}) {
    CAPTURE(limit);
    Session session(read_mechanism_text(R"yaml(
gravity: [0, -9.81, 0]
nodes: {arm: {position: [0.5, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1]}}
drives: {motor: {joint: main, pid: {target: 0.9, kp: 1000, ki: 500, kd: 20, filter: 0.01, limit: )yaml" +
                                            limit + "}}}\n",
                                        "model.yaml")
                        .model);
    compute_statics(session, {});
    CHECK(session.read("joints/main/coordinate")[0] == Approx(0.9).epsilon(1e-9));
    CHECK(session.read("joints/main/drive_force")[0] == Approx(9.81 * std::cos(0.9)).epsilon(1e-8));
  }
}

TEST_CASE("a run with a controller goes on from a save to the last bit, before its limit and at it") {
  const std::string text = rotor(
      "drives: {motor: {joint: main, pid: {target: \"step(t, 0.1, 0.2)\", kp: 60, ki: 90, kd: 6, filter: 0.01, "
      "limit: 5}}}\n");
  for (const double time : {0.05, 0.3, 0.9}) {
    DynamicsOptions options;
    options.duration = 1.2;
    options.stepping.size = 0.01;
    Session session(read_mechanism_text(text, "model.yaml").model);
    Motion motion = session.dynamics(options);
    motion.advance_to(time);
    const std::vector<double> saved = session.save();
    motion.finish();
    Session other(read_mechanism_text(text, "model.yaml").model);
    Motion again = other.dynamics(options, saved);
    again.finish();
    for (const char* dataset : {"joints/main/coordinate", "joints/main/rate", "joints/main/drive_force"})
      CHECK(other.read(dataset) == session.read(dataset));
  }
}
