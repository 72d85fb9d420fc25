// Any two shapes: gaps against projections from core to core in turn, forces against differences of the potential, and
// no jumps of force on ways over all their features.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/math/so3.hpp"
#include "tests/support/placed_shapes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/triangulated.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

using Kind = ContactShape::Kind;

const ContactShape thick_cylinder = round_shape(Kind::cylinder, 0.3, 0.2, 0.05),
                   slim_cylinder = round_shape(Kind::cylinder, 0.15, 0.5, 0.04),
                   brick = box_shape({0.3, 0.2, 0.4}, 0.05), long_capsule = round_shape(Kind::capsule, 0.1, 0.5),
                   stl_brick = surface_shape(box_of_triangles({0.3, 0.2, 0.4}));

/// Returns the point of a core that is nearest to p, in its axes.
Vector3 projected(const ContactShape& shape, const Vector3& p) {
  Vector3 q = p;
  if (shape.kind == Kind::surface) return p.cwiseMax(-Vector3(0.3, 0.2, 0.4)).cwiseMin(Vector3(0.3, 0.2, 0.4));
  if (shape.kind == Kind::box) {
    const Vector3 half = shape.half - Vector3::Constant(shape.rounding);
    return p.cwiseMax(-half).cwiseMin(half);
  }
  const double half = shape.half_length - shape.rounding, out = p.head<2>().norm(), R = shape.radius - shape.rounding;
  q.z() = std::clamp(p.z(), -half, half);
  if (shape.kind == Kind::capsule)
    q.head<2>().setZero();
  else if (out > R)
    q.head<2>() *= R / out;
  return q;
}

/// Returns the distance of a point, in the axes of the shape, from its core.
double from_core(const ContactShape& shape, const Vector3& p) { return (p - projected(shape, p)).norm(); }

/// Returns the distance of two cores, by alternating projections with over-relaxed steps.
double searched_distance(const ContactShape& a, const ContactShape& b, const Vector3& x, const Matrix3& A) {
  Vector3 p = Vector3::Zero(), before = p;
  double least = 1e300;
  for (int k = 0; k < 4000; ++k) {
    const Vector3 ahead = p + k / (k + 3.) * (p - before);  // Nesterov's, for a distance that is convex
    const Vector3 on_b = x + A * projected(b, A.transpose() * (ahead - x));
    before = p;
    p = projected(a, on_b);
    least = std::min(least, (p - x - A * projected(b, A.transpose() * (p - x))).norm());
  }
  return least;
}

NormalLaw quadratic() {
  NormalLaw law;
  law.stiffness = 1e6;
  law.exponent = 2;
  return law;
}

struct Pair {
  const char* name;
  const ContactShape *a, *b;
};

std::vector<Pair> pairs() {
  return {{"cylinder, cylinder", &thick_cylinder, &slim_cylinder},
          {"box, cylinder", &brick, &slim_cylinder},
          {"box, flat cylinder", &brick, &thick_cylinder},
          {"capsule, cylinder", &long_capsule, &thick_cylinder},
          {"surface, capsule", &stl_brick, &long_capsule},
          {"surface, cylinder", &stl_brick, &thick_cylinder},
          {"surface, box", &stl_brick, &brick}};
}

/// Checks that forces and moments do not jump along paths that move one shape over the other at a depth of a part of
/// the skins, turning it.
void check_jumps(int ways) {
  const NormalLaw law = quadratic();
  for (const auto& [name, a, b] : pairs()) {
    CAPTURE(name);
    Random random(7);
    for (int way = 0; way < ways; ++way) {
      const Vector3 u = random.vector3(1), v = random.vector3(1), turn = random.vector3(2.5), start = random.vector3(3);
      const PlacedShape<double> one = placed_at(*a, Vector3::Zero());
      const double deep = 0.5 * (a->skin() + b->skin());
      const auto pose = [&](double s) {
        const Vector3 direction = (std::cos(s) * u + std::sin(s) * v).normalized();
        const Matrix3 A = exp_so3(Vector3(s * turn)) * exp_so3(start);
        double low = 0, high = 2;  // fraction of the path at the required depth
        for (int k = 0; k < 30; ++k) {
          const double middle = 0.5 * (low + high);
          (find_nearest_place(one, placed_at(*b, middle * direction, A)).depth > deep ? low : high) = middle;
        }
        return std::pair<Vector3, Matrix3>(low * direction, A);
      };
      double coarse = 0, fine = 0, size = 0;
      for (int k = 0; k < 24; ++k) {
        const double s = 0.12 * k;
        const auto [x, A] = pose(s);
        const Pressed from = pressed(one, placed_at(*b, x, A), law);
        size = std::max(size, from.force.norm());
        // The shape moves a short way from there along a straight line, in pieces.
        const Vector3 along = 0.01 * (k % 2 ? u : v), spin = 0.02 * turn;
        const auto jump = [&](int pieces) {
          double most = 0;
          Pressed before = from;
          for (int p = 1; p <= pieces; ++p) {
            const double t = static_cast<double>(p) / pieces;
            const PlacedShape<double> other = placed_at(*b, x + t * along, exp_so3(Vector3(t * spin)) * A);
            if (find_nearest_place(one, other).depth > 0.95 * (a->skin() + b->skin()))
              break;  // nothing is defined
                      // there
            const Pressed now = pressed(one, other, law);
            most = std::max({most, (now.force - before.force).norm(), (now.moment - before.moment).norm()});
            before = now;
          }
          return most;
        };
        coarse = std::max(coarse, jump(10));
        fine = std::max(fine, jump(160));
      }
      CHECK(size > 100);
      CHECK(fine < 0.25 * coarse + 1e-9 * size);  // a jump would stay
    }
  }
}

}  // namespace

TEST_CASE("gaps of any two shapes are the distances of their surfaces, with the place halfway between them") {
  for (const auto& [name, a, b] : pairs()) {
    CAPTURE(name);
    Random random(3);
    double domes = 0;  // within the exact ends by no more than this
    for (const ContactShape* shape : {a, b})
      if (shape->kind == Kind::cylinder) domes += shape->dome_height();
    int compared = 0;
    for (int k = 0; k < 150; ++k) {
      const Vector3 x = random.vector3(0.9);
      const Matrix3 A = exp_so3(random.vector3(3));
      const double apart = searched_distance(*a, *b, x, A);
      if (apart < 0.01) continue;
      ++compared;
      const double expected = apart - a->skin() - b->skin();
      for (const bool first : {true, false}) {
        const PlacedShape<double> one = placed_at(*a, Vector3::Zero()), other = placed_at(*b, x, A);
        const Touch<double> found = first ? find_nearest_place(one, other) : find_nearest_place(other, one);
        const double gap = -found.depth;
        CHECK(gap > expected - 1e-5);
        CHECK(gap < expected + domes + 1e-9);
        // The surfaces lie at half the gap to either side of the place along the normal, and at the skin's thickness
        // from their cores.
        const Vector3 half = (first ? 0.5 : -0.5) * gap * value_of(found.normal), place = value_of(found.place);
        CHECK_THAT(from_core(*a, place - half), Catch::WithinAbs(a->skin(), domes + 1e-5));
        CHECK_THAT(from_core(*b, A.transpose() * (place + half - x)), Catch::WithinAbs(b->skin(), domes + 1e-5));
      }
    }
    CHECK(compared > 50);
  }
}

TEST_CASE("forces of any two shapes are the derivatives of their potential") {
  const NormalLaw law = quadratic();
  for (const auto& [name, a, b] : pairs()) {
    CAPTURE(name);
    Random random(5);
    int pressing = 0;
    for (int k = 0; k < 4000 && pressing < 60; ++k) {
      const Vector3 x = random.vector3(0.9);
      const Matrix3 A = exp_so3(random.vector3(3));
      const PlacedShape<double> one = placed_at(*a, Vector3::Zero());
      const double depth = find_nearest_place(one, placed_at(*b, x, A)).depth;
      if (depth <= 0 || depth > 0.8 * (a->skin() + b->skin())) continue;
      ++pressing;
      const Pressed now = pressed(one, placed_at(*b, x, A), law);
      constexpr double h = 1e-7;
      for (int i = 0; i < 3; ++i) {
        const Vector3 e = h * Vector3::Unit(i);
        const double push = (pressed(one, placed_at(*b, x + e, A), law).potential -
                             pressed(one, placed_at(*b, x - e, A), law).potential) /
                            (2 * h);
        const double turn = (pressed(one, placed_at(*b, x, exp_so3(e) * A), law).potential -
                             pressed(one, placed_at(*b, x, exp_so3(Vector3(-e)) * A), law).potential) /
                            (2 * h);
        CHECK(-push == Approx(now.force[i]).margin(1e-4 * now.force.norm() + 1e-3));
        CHECK(-turn == Approx(now.moment[i]).margin(1e-4 * now.force.norm() + 1e-3));
      }
    }
    CHECK(pressing >= 20);
  }
}

TEST_CASE("forces and moments of any two shapes do not jump") { check_jumps(2); }

TEST_CASE("forces and moments of any two shapes do not jump on more ways", "[long]") { check_jumps(5); }
