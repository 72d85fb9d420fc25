#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/solids/thick_ellipse.hpp"

using namespace bielle::test;

TEST_CASE("A thick elliptic plate (NAFEMS LE10): the stress at the opening approaches the target") {
  const double coarse = thick_ellipse_stress({6, 9, 2}), fine = thick_ellipse_stress({12, 18, 4});
  INFO(coarse << " " << fine);
  CHECK(std::abs(fine / thick_ellipse_target - 1) < 0.02);
  CHECK(std::abs(fine - thick_ellipse_target) < std::abs(coarse - thick_ellipse_target));
}
