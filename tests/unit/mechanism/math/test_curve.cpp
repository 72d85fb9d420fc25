#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/math/curve.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/finite_difference.hpp"

using bielle::mechanism::Curve;
using bielle::mechanism::MatrixX;
using bielle::mechanism::Vector3;

namespace {

/// Returns n points of a circle of radius 2 about (0, 1, 0), in a plane inclined to the axes.
MatrixX circle(int n, double turn) {
  MatrixX points(n, 3);
  const Vector3 x = Vector3(1, 0, 1).normalized(), y = Vector3::UnitY();
  for (int k = 0; k < n; ++k) {
    const double angle = turn * k / n;
    points.row(k) = (Vector3::UnitY() + 2 * std::cos(angle) * x + 2 * std::sin(angle) * y).transpose();
  }
  return points;
}

}  // namespace

TEST_CASE("a closed curve through a circle is a circle, as long and as curved, any number of times round") {
  const Curve curve(circle(60, 2 * M_PI), true, "circle");
  const double length = curve.arc_length(curve.end());
  CHECK(length == Approx(4 * M_PI).epsilon(1e-6));
  CHECK(curve.arc_length(2.5 * curve.end()) == Approx(2.5 * length).epsilon(1e-9));
  CHECK(curve.arc_length(-curve.end()) == Approx(-length).epsilon(1e-12));
  for (double u = -3; u < 40; u += 0.37) {
    const Curve::Place c = curve(u);
    CHECK((c.point - Vector3::UnitY()).norm() == Approx(2).epsilon(1e-6));
    const double speed = c.first.norm();
    CHECK(c.first.cross(c.second).norm() / std::pow(speed, 3) == Approx(0.5).epsilon(4e-3));
  }
}

TEST_CASE("the derivatives of a curve are those of its points, and of its arc length") {
  const Curve curve(circle(7, 4), false, "arc");
  for (const double u : {0.31, 1.7, 4.9}) {  // away from the points
    const Curve::Place c = curve(u);
    const auto point = [&](double s) -> Eigen::VectorXd { return curve(u + s).point; };
    const auto slope = [&](double s) -> Eigen::VectorXd { return curve(u + s).first; };
    CHECK((bielle::test::derivative(point, 0.05) - c.first).norm() < 1e-10);
    CHECK((bielle::test::derivative(slope, 0.05) - c.second).norm() < 1e-10);
    const auto length = [&](double s) -> double { return curve.arc_length(u + s); };
    CHECK(bielle::test::derivative(length, 0.05) == Approx(c.first.norm()).epsilon(1e-10));
  }
}

TEST_CASE("an open curve goes on straight beyond its ends") {
  const Curve curve(circle(7, 4), false, "arc");
  const Curve::Place end = curve(curve.end()), beyond = curve(curve.end() + 0.5);
  CHECK((beyond.point - end.point - 0.5 * end.first).norm() < 1e-14);
  CHECK(beyond.second.norm() == 0);
  CHECK(curve.arc_length(curve.end() + 0.5) - curve.arc_length(curve.end()) == Approx(0.5 * end.first.norm()));
  CHECK(curve.arc_length(-0.5) == Approx(-0.5 * curve(0).first.norm()));
}

TEST_CASE("the nearest place of a curve is at right angles to the way there") {
  const Curve curve(circle(40, 2 * M_PI), true, "circle");
  for (const Vector3& point : {Vector3(1, 2, 3), Vector3(-4, 0, 1), Vector3(0.3, 1.2, 0)}) {
    const double u = curve.nearest(point);
    const Curve::Place c = curve(u);
    CHECK(std::abs((point - c.point).dot(c.first)) < 1e-12);
    for (double other = 0; other < curve.end(); other += 0.01)
      CHECK((curve(other).point - point).norm() > (c.point - point).norm() - 1e-12);
  }
}

TEST_CASE("points of a curve that coincide are named") {
  MatrixX points = circle(5, 4);
  points.row(3) = points.row(2);
  CHECK_THROWS_WITH(Curve(points, false, "path.csv"), "path.csv: points 3 and 4 coincide");
  points.row(4) = points.row(0);
  CHECK_THROWS_WITH(Curve(points.bottomRows(2), true, "path.csv"), Catch::Contains("three points"));
  MatrixX repeated = circle(5, 4);
  repeated.row(4) = repeated.row(0);
  CHECK_THROWS_WITH(Curve(repeated, true, "path.csv"), Catch::Contains("does not repeat its first point"));
}
