// Cylinders on boxes and on each other: closed forms of rolling, sliding and resting, force per place, energy and
// momentum.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/contacts/pair_touches.hpp"
#include "mechanism/math/so3.hpp"
#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/placed_shapes.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_cylinders {
namespace {

constexpr double k = 1e6;

/// Returns the depth at which n places bear a weight.
double depth(double weight, int n) { return std::pow(weight / (n * k), 1 / 1.5); }

}  // namespace

TEST_CASE("a cylinder rolls down a ramp of a box, or slides on it, as closed forms say") {
  constexpr double slope = 0.3, R = 0.1, m = 2, J = 0.5 * m * R * R;
  // Gravity is inclined instead of the ramp: x points down the slope. The body begins at its depth of rest.
  const std::string gravity = fmt::format("[{:.17g}, 0, {:.17g}]", g * std::sin(slope), -g * std::cos(slope));
  const double rest = depth(m * g * std::cos(slope), 2);
  // The body rolls on places halfway between the surfaces.
  const double lever = R - 0.5 * rest, rolling = g * std::sin(slope) / (1 + J / (m * lever * lever)),
               sliding = g * (std::sin(slope) - 0.05 * std::cos(slope));
  for (const bool rolls : {true, false}) {
    CAPTURE(rolls);
    const std::string text = contact_model(
        {{"b",
          fmt::format("position: [0, 0, {:.17g}], rotation_vector: [{:.17g}, 0, 0]", R - rest, 0.5 * M_PI),
          m,
          {0.02, 0.02, J}}},
        fmt::format("  it: {{type: contact, shapes: [{{node: ground, box: [10, 2, 0.4], at: [0, 0, -0.2]}}, {{node: b, "
                    "cylinder: [0.1, 0.3]}}], stiffness: 1e6, damping: 1, friction: {{coefficient: {}, velocity: "
                    "1e-4}}}}\n",
                    rolls ? 0.6 : 0.05),
        gravity);
    double x = 0, v = 0, spin = 0;
    run_contact(text, {1e-3, 1}, [&](const Session& session, const Motion&) {
      x = session.node("b").x.x();
      v = session.node("b").v.x();
      spin = session.node("b").Omega.z();  // about its axis, -y
    });
    const double a = rolls ? rolling : sliding;
    CHECK(v == Approx(a).epsilon(2e-4));
    CHECK(x == Approx(0.5 * a).epsilon(2e-4));
    // If it rolls, friction makes it turn without slip. If it slides, J spin' = mu N lever.
    CHECK(std::abs(spin) == Approx(rolls ? a / lever : 0.05 * m * g * std::cos(slope) * lever / J).epsilon(1e-2));
  }
}

TEST_CASE("cylinders stand on a box and on each other at the depths of their weights") {
  // Damping brings the bodies to rest. Each standing end has one place on a box; between two cylinders there are the
  // places of both ends.
  const double m = 1.5;
  const std::string text = contact_model(
      {{"low", "position: [0, 0, 0.1]", m, {0.01, 0.01, 0.01}},
       {"high", "position: [0, 0, 0.3]", m, {0.01, 0.01, 0.01}}},
      "  it: {type: contact, shapes: [{node: ground, box: [1, 1, 0.2], at: [0, 0, -0.1]}, {node: low, cylinder: [0.15, "
      "0.2]}, {node: high, cylinder: [0.1, 0.2]}], stiffness: 1e6, damping: 5, friction: {coefficient: 0.5}}\n",
      "[0, 0, -9.81]");
  double low = 0, high = 0, tilt = 0;
  run_contact(text, {1e-3, 3}, [&](const Session& session, const Motion&) {
    low = session.node("low").x.z();
    high = session.node("high").x.z();
    tilt = std::max(tilt, std::acos(std::min(1.0, session.node("high").R(2, 2))));
  });
  CHECK(tilt < 0.02);
  CHECK(low == Approx(0.1 - depth(2 * m * g, 1)).margin(2e-6));
  CHECK(high - low == Approx(0.2 - depth(m * g, 2)).margin(4e-6));
}

TEST_CASE("crossed rods touch in one place, parallel ones at both ends of the shorter") {
  const ContactShape a = round_shape(ContactShape::Kind::cylinder, 0.1, 0.5, 0.02),
                     b = round_shape(ContactShape::Kind::cylinder, 0.08, 0.3, 0.02);
  NormalLaw law;
  law.stiffness = k;
  law.exponent = 1.5;
  constexpr double p = 1e-3;
  const double whole = k * std::pow(p, 1.5);
  const Vector3 over(0.1 + 0.08 - p, 0, 0);
  PairTouches<double> found;
  find_touches(placed_at(a, Vector3::Zero()), placed_at(b, over, exp_so3(Vector3(0.5 * M_PI, 0, 0))), law, found);
  REQUIRE(found.touches.size() == 1);
  CHECK(found.touches[0].force == Approx(whole).epsilon(1e-12));
  CHECK((value_of(found.touches[0].normal) - Vector3::UnitX()).norm() < 1e-12);
  CHECK((value_of(found.touches[0].place) - Vector3(0.1 - 0.5 * p, 0, 0)).norm() < 1e-12);
  // Side by side, they touch at either end of the shorter one, at the radius of its domes.
  find_touches(placed_at(a, Vector3::Zero()), placed_at(b, over), law, found);
  REQUIRE(found.touches.size() == 2);
  for (const auto& touch : found.touches) {
    CHECK(touch.force == Approx(whole).epsilon(1e-12));
    CHECK(std::abs(value_of(touch.place).z()) == Approx(0.3 - 0.02 - b.dome_height()).epsilon(1e-12));
  }
}

TEST_CASE("cylinders that fly into each other and into boxes keep energy and momentum without friction") {
  for (const char* other : {"cylinder: [0.15, 0.5]", "box: [0.3, 0.2, 0.5]"}) {
    CAPTURE(other);
    const std::string text = contact_model(
        {{"a", "position: [0, 0, 0], angular_velocity: [1, 2, -1]", 1.5, {0.03, 0.03, 0.02}},
         {"b",
          "position: [0.05, 0.35, 0.1], velocity: [0.2, -2, 0.1], rotation_vector: [1.2, 0.4, 0.3], "
          "angular_velocity: [-2, 1, 3]",
          1,
          {0.02, 0.02, 0.01}}},
        fmt::format("  it: {{type: contact, shapes: [{{node: a, {}}}, {{node: b, cylinder: [0.1, 0.4]}}], stiffness: "
                    "1e6}}\n",
                    other));
    double worst = 0, drift = 0, turned = 0;
    int touches = 0;
    Vector3 momentum = Vector3::Zero(), moment = momentum;
    run_contact(text, {2e-5, 0.25, 0, 1}, [&](const Session& session, const Motion& motion) {
      worst = std::max(worst, std::abs(motion.balance()));
      const NodeState &a = session.node("a"), &b = session.node("b");
      const Vector3 p = 1.5 * a.v + b.v;
      const Vector3 L = 1.5 * a.x.cross(a.v) + b.x.cross(b.v) + a.R * Vector3(0.03, 0.03, 0.02).cwiseProduct(a.Omega) +
                        b.R * Vector3(0.02, 0.02, 0.01).cwiseProduct(b.Omega);
      if (session.time() == 0) {
        momentum = p;
        moment = L;
      }
      drift = std::max(drift, (p - momentum).norm());
      turned = std::max(turned, (L - moment).norm());
      if (session.read("contacts/it/state")[0] > 0) ++touches;
    });
    CHECK(touches > 5);
    CHECK(worst < 2e-4 * 2);  // energies are some 2 J
    CHECK(drift < 1e-9);
    CHECK(turned < 1e-5);  // error of the steps
  }
}

}  // namespace test_cylinders
