// Placed and mirrored parts against vectors that are placed and mirrored by hand.

#include <catch2/catch.hpp>

#include "mechanism/language/placement.hpp"
#include "mechanism/math/rotation_parameters.hpp"

using namespace bielle::mechanism;
using Geometry = bielle::KeyForm::Geometry;

namespace {

Placement placed(const Vector3& x, const Vector3& turn, int mirrored) {
  Placement placement;
  placement.frame = {x, RotationVector::rotation(turn)};
  placement.mirrored = mirrored;
  return placement;
}

}  // namespace

TEST_CASE("a node's own components are reflected like those of its part") {
  const Matrix3 R = RotationVector::rotation(Vector3(0.3, -1.1, 2.0));
  const Vector3 own(0.2, -0.7, 1.3);
  for (const int mirrored : {-1, 0, 1, 2}) {
    const Placement placement = placed({1, 2, 3}, {0.5, 0.1, -0.4}, mirrored);
    const Matrix3 there = placement.orientation(R, true);
    CHECK(there.determinant() == Approx(1));
    // The vector of the part, R own, goes to frame.R M R own; the node there has these components of it.
    const Vector3 expected = placement.matrix(Geometry::vector, true) * (R * own);
    CHECK((there * (placement.matrix(Geometry::vector, false) * own) - expected).norm() < 1e-14);
  }
}

TEST_CASE("an axial vector is turned round in a mirror, so that the velocity of a point is mirrored") {
  const Vector3 omega(1, -2, 0.5), arm(0.3, 0.8, -0.1);
  for (const int mirrored : {0, 1, 2}) {
    const Placement placement = placed({0, 0, 0}, {0.5, 0.1, -0.4}, mirrored);
    const Vector3 there = placement.matrix(Geometry::axial, true) * omega;
    const Matrix3 M = placement.matrix(Geometry::vector, true);
    CHECK((there.cross(M * arm) - M * omega.cross(arm)).norm() < 1e-14);
  }
}

TEST_CASE("a part within a part goes where both placements take it") {
  const Vector3 point(0.2, -0.7, 1.3);
  const auto place = [](const Placement& placement, const Vector3& p) {
    return Vector3(placement.frame.x + placement.matrix(Geometry::point, true) * p);
  };
  for (const int outer : {-1, 0, 1, 2})
    for (const int inner : {-1, 0, 1, 2}) {
      const Placement first = placed({1, 2, 3}, {0.5, 0.1, -0.4}, outer),
                      second = placed({-1, 0, 2}, {1, 2, 0.3}, inner);
      CHECK((place(first.inner(second), point) - place(first, place(second, point))).norm() < 1e-14);
      CHECK(first.inner(second).frame.R.determinant() == Approx(1));
    }
}
