// A capsule against a cylinder: distances against a search over all places of the capsule's line, forces that are
// continuous on the path from the side over the rim to the end, the depth at rest in closed form, and no generation of
// energy.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/contacts/pair_touches.hpp"
#include "mechanism/math/so3.hpp"
#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

constexpr double R = 0.3, half = 0.4, rounding = 0.05, r = 0.1, half_line = 0.5;

ContactShape cylinder() {
  ContactShape shape;
  shape.kind = ContactShape::Kind::cylinder;
  shape.radius = R;
  shape.half_length = half;
  shape.rounding = rounding;
  shape.complete();
  return shape;
}

ContactShape capsule() {
  ContactShape shape;
  shape.kind = ContactShape::Kind::capsule;
  shape.radius = r;
  shape.half_length = half_line;
  shape.complete();
  return shape;
}

PlacedShape<double> placed(const ContactShape& shape, const Vector3& x, const Matrix3& A) {
  PlacedShape<double> result;
  result.shape = &shape;
  result.origin = Triple<double>(x);
  for (int k = 0; k < 3; ++k) result.axes[static_cast<std::size_t>(k)] = Triple<double>(Vector3(A.col(k)));
  return result;
}

/// Returns the distance of a point from the rounded cylinder about z.
double distance(const Vector3& p) {
  const double out = std::max(0.0, std::hypot(p.x(), p.y()) - (R - rounding)),
               beyond = std::max(0.0, std::abs(p.z()) - (half - rounding));
  return std::hypot(out, beyond) - rounding;
}

double searched(const Vector3& x, const Vector3& along) {
  double low = -half_line, high = half_line;
  for (int k = 0; k < 200; ++k) {  // the distance is convex
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (distance(x + a * along) < distance(x + b * along) ? high : low) =
        distance(x + a * along) < distance(x + b * along) ? b : a;
  }
  return distance(x + 0.5 * (low + high) * along) - r;
}

std::string text(const std::string& node, const std::string& law, double mass, const std::string& gravity) {
  return contact_model({{"rod", node, mass, {0.05, 0.05, 0.01}}},
                       "  it: {type: contact, shapes: [{node: ground, cylinder: [0.3, 0.8], rounding: 0.05}, {node: "
                       "rod, capsule: [0.1, 1]}], stiffness: 1e6, " +
                           law + "}\n",
                       gravity);
}

}  // namespace

TEST_CASE("the gap of capsule and cylinder is the smallest distance of the capsule's line") {
  const ContactShape a = cylinder(), b = capsule();
  Random random(11);
  int between_ends = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector3 x = random.vector3(0.8);
    const Matrix3 A = exp_so3(random.vector3(3));
    const double expected = searched(x, A.col(2));
    if (expected < -r) continue;  // the line goes through the core, or nearly so
    const PlacedShape<double> one = placed(a, Vector3::Zero(), Matrix3::Identity()), other = placed(b, x, A);
    for (const bool first : {true, false}) {
      const Touch<double> found = first ? find_nearest_place(one, other) : find_nearest_place(other, one);
      // The cylinder's ends are domes within the exact ones.
      CHECK(-found.depth > expected - 1e-9);
      CHECK(-found.depth < expected + a.dome_height() + 1e-9);
    }
    const double ends = std::min(distance(x + half_line * A.col(2)), distance(x - half_line * A.col(2))) - r;
    if (ends > expected + 1e-6) ++between_ends;
  }
  CHECK(between_ends > 200);
}

TEST_CASE("forces of a capsule on a cylinder stay continuous over side, rim and end") {
  const ContactShape a = cylinder(), b = capsule();
  NormalLaw law;
  law.stiffness = 1e6;
  law.exponent = 1.5;
  const PlacedShape<double> one = placed(a, Vector3::Zero(), Matrix3::Identity());
  PairTouches<double> found;
  // Tilted lines move over the rim, 1 cm deep in the skins.
  for (const double tilt : {0.0, 1e-3, 0.02, 0.3, 1.0}) {
    CAPTURE(tilt);
    const Matrix3 A = exp_so3(Vector3(0.5 * M_PI - tilt, 0, 0.2));
    bool known = true;
    const auto force_at = [&](double s) {
      // The path leads along the side upwards, around the rim, and along the end inwards.
      const double z = std::min(half - rounding, -0.2 + s), x = R - rounding - std::max(0.0, s - 0.75);
      const double around = std::clamp((s - 0.55) / 0.2, 0.0, 1.0) * 0.5 * M_PI;
      const Vector3 n(std::cos(around), 0, std::sin(around));
      const PlacedShape<double> other = placed(b, Vector3(x, 0.02, z) + (rounding + r - 0.01) * n, A);
      Vector3 sum = Vector3::Zero();
      // Steep lines pass through the core, where no distance is defined.
      known = find_nearest_place(one, other).depth < 0.9 * (rounding + r);
      if (!known) return sum;
      find_touches(one, other, law, found);
      for (const Touch<double>& touch : found.touches) {
        CHECK(touch.load >= 0);
        sum += touch.force * value_of(touch.normal);
      }
      return sum;
    };
    double jump = 0, finer = 0, size = 0;
    for (int k = 0; k < 4000; ++k) {
      const double s = k * 2.5e-4;
      const Vector3 now = force_at(s);
      if (!known) continue;
      const Vector3 near = force_at(s + 2.5e-5);
      if (!known) continue;
      const Vector3 far = force_at(s + 2.5e-4);
      if (!known) continue;
      size = std::max(size, now.norm());
      jump = std::max(jump, (far - now).norm());
      finer = std::max(finer, (near - now).norm());
    }
    CHECK(size > 500);
    CHECK(finer < 0.2 * jump);  // a jump would stay
  }
}

TEST_CASE("a rod that lies across an end of a cylinder is borne by it, level or not") {
  const ContactShape a = cylinder(), b = capsule();
  NormalLaw law;
  law.stiffness = 1e6;
  law.exponent = 1.5;
  constexpr double deep = 1e-3;
  const PlacedShape<double> one = placed(a, Vector3::Zero(), Matrix3::Identity());
  PairTouches<double> found;
  for (const double tilt : {-1e-3, -1e-6, 0.0, 1e-6, 1e-3}) {
    CAPTURE(tilt);
    find_touches(one, placed(b, Vector3(0, 0, half + r - deep), exp_so3(Vector3(0.5 * M_PI + tilt, 0, 0))), law, found);
    REQUIRE(found.touches.size() == 1);
    // The contact is in the middle of the dome. From there it moves with the tilt by R/H of it, R the core's radius, H
    // = R/100.
    CHECK(found.touches[0].force == Approx(1e6 * std::pow(deep, 1.5)).epsilon(0.1));
    CHECK(std::abs(found.touches[0].place.y) ==
          Approx(100 * std::abs(tilt) * (R - rounding)).epsilon(0.02).margin(1e-9));
  }
}

TEST_CASE("a rod across a lying cylinder rests at the depth of its weight") {
  // Both shapes lie; the rod lies across the cylinder's side and is held against tilting.
  const double mass = 4, g = 9.81, depth = std::pow(mass * g / 1e6, 1 / 1.5);
  double x = 0;
  run_contact(text(fmt::format("position: [{:.17g}, 0, 0.1], rotation_vector: [{:.17g}, 0, 0], fixed: [rx, ry, rz]",
                               R + r - 0.5 * depth, 0.5 * M_PI),
                   "damping: 2", mass, "[-9.81, 0, 0]"),
              {1e-3, 3}, [&](const Session& session, const Motion&) { x = session.node("rod").x.x(); });
  CHECK(x == Approx(R + r - depth).margin(1e-9));
}

TEST_CASE("a rod that tumbles over a cylinder without friction keeps its energy") {
  double worst = 0;
  bool touched = false;
  run_contact(text("position: [0.2, 0.1, 0.9], velocity: [-0.3, 0.1, -2], rotation_vector: [1.3, 0.2, 0.3], "
                   "angular_velocity: [0.5, 2, 0.3]",
                   "exponent: 1.5", 2, "[0, 0, 0]"),
              {2e-5, 0.5, 0, 1}, [&](const Session& session, const Motion& motion) {
                worst = std::max(worst, std::abs(motion.balance()));
                touched = touched || session.read("contacts/it/state")[0] > 0;
              });
  CHECK(touched);
  CHECK(worst < 1e-4 * 4);  // energies are some 4 J
}
