// Impacts: restitution against the closed form of Hunt and Crossley's law, Newton's cradle against its differential
// equation, momentum, and steps that become short at impacts and miss none.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace {

constexpr double stiffness = 1e6;

/// Returns the restitution of a ball of 1 kg that flies against a plane at a speed. @param expected  expected
/// restitution, which determines the time of separation
double restitution_of(const std::string& law, double speed, double expected, double tolerance = 0) {
  const double T = impact_time(1, stiffness, 1.5, speed), gap = 0.5 * speed * T;
  const std::string text =
      contact_model({{"ball", fmt::format("position: [0, 0, {:.17g}], velocity: [0, 0, {:.17g}]", 0.1 + gap, -speed)}},
                    "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], "
                    "stiffness: 1e6, " +
                        law + "}\n");
  double after = 0, gap_after = 0;
  run_contact(text, {T / 400, 6 * T / expected, tolerance}, [&](const Session& session, const Motion&) {
    after = session.node("ball").v.z();
    gap_after = session.read("contacts/it/gap")[0];
  });
  REQUIRE(gap_after > 0);
  return after / speed;
}

/// Returns the restitution of K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440: the root e of
/// c (1 + e) = ln((1 + c)/(1 - e c)), by bisection; at e = 0 the left side is the larger one.
/// @param c  damping times speed
double hunt_and_crossley(double c) {
  double low = 0, high = std::min(1.0, 1 / c);
  for (int k = 0; k < 60; ++k) {
    const double e = 0.5 * (low + high);
    (c * (1 + e) > std::log1p(c) - std::log1p(-e * c) ? low : high) = e;
  }
  return low;
}

/// Positions and velocities of five balls.
using Line = Eigen::Matrix<double, 10, 1>;

}  // namespace

TEST_CASE("a bouncing ball has the restitution of its damping over three decades of speed") {
  // The errors are of second order with 600 steps per impact.
  for (const double speed : {0.01, 0.1, 1.0, 10.0})
    for (const double damping : {0.05, 0.5, 5.0}) {
      CAPTURE(speed, damping);
      const double expected = hunt_and_crossley(damping * speed);
      CHECK_THAT(restitution_of(fmt::format("damping: {}", damping), speed, expected),
                 Catch::WithinAbs(expected, 3e-4));
    }
}

TEST_CASE("a given restitution is that of every speed") {
  for (const double speed : {0.01, 0.1, 1.0, 10.0})
    for (const double wanted : {0.2, 0.5, 0.9, 1.0}) {
      CAPTURE(speed, wanted);
      CHECK_THAT(restitution_of(fmt::format("restitution: {}", wanted), speed, wanted), Catch::WithinAbs(wanted, 3e-4));
    }
}

TEST_CASE("adaptive steps find the restitution as well, from flights of any length") {
  for (const double speed : {0.01, 1.0, 10.0}) {
    CAPTURE(speed);
    CHECK_THAT(restitution_of("restitution: 0.6", speed, 0.6, 1e-8), Catch::WithinAbs(0.6, 2e-3));
  }
}

TEST_CASE("Newton's cradle of five balls moves as its differential equation") {
  for (const double damping : {0.0, 0.1}) {
    CAPTURE(damping);
    std::vector<Body> bodies;
    std::string shapes;
    for (int k = 0; k < 5; ++k) {
      // The first ball arrives at 1 m/s; the others are 1 micrometre apart.
      const double x = k == 0 ? -1e-3 : 0.1 * k + 1e-6 * k;
      bodies.push_back({fmt::format("b{}", k),
                        fmt::format("position: [{:.17g}, 0, 0], velocity: [{}, 0, 0], fixed: [y, z, rx, ry, rz]", x,
                                    k == 0 ? 1 : 0)});
      shapes += fmt::format("{}{{node: b{}, sphere: 0.05}}", k == 0 ? "" : ", ", k);
    }
    const std::string text = contact_model(
        bodies, fmt::format("  it: {{type: contact, shapes: [{}], stiffness: 1e8, damping: {}}}\n", shapes, damping));
    Line z = Line::Zero();
    const auto rate = [&](const Line& at) {
      Line change = Line::Zero();
      change.head<5>() = at.tail<5>();
      for (int k = 0; k < 4; ++k) {
        const double p = at[k] - at[k + 1] + 0.1, v = at[5 + k] - at[6 + k];
        if (p <= 0) continue;
        const double F = 1e8 * std::pow(p, 1.5) * std::max(0.0, 1 + damping * v);
        change[5 + k] -= F;
        change[6 + k] += F;
      }
      return change;
    };
    const double h = 2e-6, end = 0.012;
    double time = 0;
    for (int k = 0; k < 5; ++k) z[k] = k == 0 ? -1e-3 : 0.1 * k + 1e-6 * k;
    z[5] = 1;
    double largest = 0;
    run_contact(text, {h, end}, [&](const Session& session, const Motion&) {
      if (session.time() > time) {
        advance_by_runge_kutta(z, session.time() - time, 4, rate);
        time = session.time();
      }
      for (int k = 0; k < 5; ++k)
        largest = std::max(largest, std::abs(session.node(fmt::format("b{}", k)).v.x() - z[5 + k]));
    });
    CHECK(largest < 2e-4);  // relative to 1 m/s; an impact takes about 100 steps
    CHECK(z[9] > 0.8);      // the last ball has flown off
  }
}

TEST_CASE("momentum and angular momentum of what collides freely stay what they were") {
  const std::string text = contact_model(
      {{"a",
        "position: [0, 0, 0], velocity: [1, 0.2, 0], angular_velocity: [3, 1, -2], rotation_vector: [0.1, 0.5, 0.3]",
        2,
        {0.02, 0.03, 0.04}},
       {"b",
        "position: [0.45, 0.05, 0.02], velocity: [-1, 0, 0.1], angular_velocity: [0, 4, 1]",
        1,
        {0.01, 0.02, 0.015}},
       {"c", "position: [0.45, 0.5, 0], velocity: [0, -3, 0]", 0.5, {0.002, 0.002, 0.002}}},
      "  it: {type: contact, shapes: [{node: a, box: [0.3, 0.4, 0.5]}, {node: b, capsule: [0.1, 0.3]}, {node: c, "
      "sphere: "
      "0.1}], stiffness: 1e6, damping: 0.2, friction: {coefficient: 0.4, velocity: 0.01}}\n");
  const std::vector<double> masses = {2, 1, 0.5};
  const std::vector<Vector3> inertias = {{0.02, 0.03, 0.04}, {0.01, 0.02, 0.015}, {0.002, 0.002, 0.002}};
  Vector6 start;
  bool begun = false, touched = false;
  double worst = 0, least = 1e300;
  run_contact(text, {2e-5, 0.2}, [&](const Session& session, const Motion& motion) {
    Vector6 momentum = Vector6::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeState& n = session.node(std::string(1, static_cast<char>('a' + k)));
      momentum.head<3>() += masses[k] * n.v;
      momentum.tail<3>() += masses[k] * n.x.cross(n.v) + n.R * inertias[k].cwiseProduct(n.Omega);
    }
    if (!begun) start = momentum;
    begun = true;
    touched = touched || session.read("contacts/it/state")[0] > 0;
    worst = std::max(worst, (momentum - start).norm());
    least = std::min(least, motion.energy().kinetic);
  });
  CHECK(touched);
  CHECK(least < 5);
  // Linear momentum is exact to rounding, angular momentum to the error of the scheme at rates of about 10 rad/s.
  CHECK(worst < 2e-6);
}

TEST_CASE("adaptive steps shorten for an impact and lengthen after it, and the energy balance closes") {
  const std::string text = contact_model(
      {{"ball", "position: [0, 0, 1.1]"}},
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e7, "
      "restitution: 0.8}\n",
      "[0, 0, -9.81]");
  double before = 0, within = 1, after = 0, last = 0, missing = 0, speed = 0;
  const double touch = std::sqrt(2 / 9.81);
  run_contact(text, {1e-3, 0.8, 1e-7}, [&](const Session& session, const Motion& motion) {
    const double h = session.time() - last;
    last = session.time();
    if (h <= 0) return;
    if (last < touch) before = std::max(before, h);
    if (session.read("contacts/it/state")[0] > 0) within = std::min(within, h);
    if (last > touch + 0.1) after = std::max(after, h);
    missing = std::max(missing, std::abs(motion.balance()));
    speed = std::max(speed, session.node("ball").v.z());
  });
  CHECK(before > 0.01);
  CHECK(within < 1e-4);
  CHECK(after > 0.01);
  CHECK_THAT(speed, Catch::WithinRel(0.8 * std::sqrt(2 * 9.81), 2e-3));
  CHECK(missing < 1e-2);  // relative to 9.8 J
}

TEST_CASE("nothing passes through a thin plate within one step") {
  // A ball of 2 cm moves at 50 m/s, 50 cm in a step of 0.01 s, against a plate of 1 mm. The result must not depend on
  // whether steps end before, in or behind the plate.
  for (const double start : {0.3, 0.21, 0.203, 0.2, 0.185, 0.05})
    for (const char* plate : {"box: [1, 1, 0.001]", "box: [1, 1, 0.001], rotation_vector: [0.3, 0, 0]"})
      for (const double tolerance : {0.0, 1e-6}) {
        CAPTURE(start, plate, tolerance);
        const std::vector<Body> ball = {
            {"ball", fmt::format("position: [0, 0, {}], velocity: [0, 0, -50]", start), 0.01, {4e-7, 4e-7, 4e-7}}};
        const std::string text = contact_model(
            ball, fmt::format("  it: {{type: contact, shapes: [{{node: ball, sphere: 0.01}}, {{node: ground, {}}}], "
                              "stiffness: 1e9}}\n",
                              plate));
        double z = 0;
        const MarchLog log = run_contact(text, {0.01, 0.02, tolerance}, [&](const Session& session, const Motion&) {
          z = session.node("ball").x.z();
        });
        CHECK(z > 0.01);
        CHECK(log.refused_by_newton + log.refused_by_error > 0);
        if (tolerance == 0)
          CHECK_THAT(log.hardest,
                     Contains("pass through each other within one step") || Contains("half their thickness"));
      }
}
