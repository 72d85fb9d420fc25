// The shortest displacement that separates two cores, against a search over all directions.
#include <algorithm>

#include <catch2/catch.hpp>

#include "mechanism/contacts/core_overlap.hpp"
#include "mechanism/math/so3.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;

namespace {

struct Placed {
  ContactShape shape;
  Vector3 x;
  Matrix3 R;
  PlacedShape<double> placed() const {
    PlacedShape<double> result;
    result.shape = &shape;
    result.origin = Triple<double>(x);
    for (std::size_t k = 0; k < 3; ++k) result.axes[k] = Triple<double>(Vector3(R.col(static_cast<Eigen::Index>(k))));
    return result;
  }
  /// Returns the largest distance of the core from its middle along a direction.
  double support(const Vector3& n) const {
    const Vector3 half = shape.kind == ContactShape::Kind::box ? Vector3(shape.half - Vector3::Constant(shape.rounding))
                                                               : Vector3(0, 0, shape.half_length);
    return half.dot((R.transpose() * n).cwiseAbs());
  }
};

/// Returns the shortest displacement that separates two convex bodies, which is the least over all directions: the
/// search is random at first, then around the best directions. Negative values are distances.
double shortest_way(const Placed& a, const Placed& b, bielle::test::Random& random) {
  const auto way = [&](const Vector3& n) { return a.support(n) + b.support(n) - n.dot(b.x - a.x); };
  double least = 1e300;
  for (int start = 0; start < 30; ++start) {
    Vector3 best = random.vector_of_length(1);
    for (int k = 0; k < 300; ++k)
      if (const Vector3 n = random.vector_of_length(1); way(n) < way(best)) best = n;
    for (double step = 0.1; step > 1e-9; step *= 0.8)
      for (int k = 0; k < 40; ++k)
        if (const Vector3 n = (best + random.vector_of_length(step)).normalized(); way(n) < way(best)) best = n;
    least = std::min(least, way(best));
  }
  return least;
}

}  // namespace

TEST_CASE("the overlap of cores is the shortest way that parts them") {
  bielle::test::Random random(7);
  int overlapping = 0;
  for (int round = 0; round < 40; ++round) {
    std::array<Placed, 2> pair;
    for (Placed& one : pair) {
      const bool box = &one == &pair[0] || round % 2 == 0;
      one.shape.kind = box ? ContactShape::Kind::box : ContactShape::Kind::capsule;
      for (int k = 0; k < 3; ++k) one.shape.half[k] = random.uniform(0.3, 1);
      one.shape.rounding = 0.1;
      one.shape.half_length = random.uniform(0.5, 1.5);
      one.shape.radius = 0.1;
      one.x = random.vector3(0.8);
      one.R = exp_so3(random.vector3(2));
    }
    const auto& [a, b] = pair;
    const auto overlap = overlap_of_cores(a.placed(), b.placed());
    const double expected = shortest_way(a, b, random);
    CAPTURE(round, expected);
    REQUIRE(overlap.has_value() == (expected > 0));
    if (!overlap) continue;
    ++overlapping;
    // The search stops within about 1e-8 rad of the best direction.
    CHECK_THAT(overlap->depth, Catch::WithinAbs(expected, 1e-6));
    CHECK_THAT(a.support(overlap->normal) + b.support(overlap->normal) - overlap->normal.dot(b.x - a.x),
               Catch::WithinAbs(overlap->depth, 1e-12));
  }
  CHECK(overlapping > 15);
}

TEST_CASE("the place of an overlap is halfway between the points of the cores nearest to the other's middle") {
  Placed a, b;
  a.shape.kind = b.shape.kind = ContactShape::Kind::box;
  a.shape.rounding = b.shape.rounding = 0.1;
  a.shape.half = Vector3::Constant(1.1);
  b.shape.half = Vector3::Constant(0.6);
  a.x.setZero();
  b.x = {1.2, 0.6, 0};
  a.R = b.R = Matrix3::Identity();
  const auto overlap = overlap_of_cores(a.placed(), b.placed());
  REQUIRE(overlap);
  CHECK(overlap->depth == Approx(1 + 0.5 - 1.2));
  CHECK((overlap->normal - Vector3::UnitX()).norm() < 1e-14);
  CHECK((overlap->place - (Vector3(1, 0.6, 0) + Vector3(0.7, 0.1, 0)) / 2).norm() < 1e-14);
}
