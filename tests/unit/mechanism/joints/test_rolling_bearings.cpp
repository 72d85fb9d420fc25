// Ball and roller bearings against Hertz' theory, Sjovall's integrals and closed forms of axial load.
#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "mechanism/joints/flexible/hertz_contact.hpp"
#include "mechanism/joints/flexible/rolling_bearing_law.hpp"
#include "tests/support/model_text.hpp"

using namespace bielle::mechanism;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace test_rolling_bearings {

RollingGeometry geometry_of(bool ball) {
  RollingGeometry geometry;
  geometry.ball = ball;
  geometry.exponent = ball ? 1.5 : 1.1;  // the value of published tables; models have 10/9
  geometry.elements = 9;
  geometry.pitch_diameter = 2;
  geometry.contact_radius = 1;
  geometry.groove_distance = 0.7;
  geometry.constant = 3;
  return geometry;
}

Vector6 along(Eigen::Index direction, double value) { return value * Vector6::Unit(direction); }

}  // namespace test_rolling_bearings

using namespace test_rolling_bearings;

// T. A. Harris, Rolling Bearing Analysis, table of the integrals J_r(eps) of Sjovall for point and line contact.
TEST_CASE("the radial force over the load zone is that of Sjovall's integrals") {
  struct Row {
    double eps, point, line;
  };
  for (const auto& [eps, point, line] : std::array<Row, 7>{{{0.1, 0.1156, 0.1268},
                                                            {0.2, 0.1590, 0.1737},
                                                            {0.3, 0.1892, 0.2055},
                                                            {0.5, 0.2288, 0.2453},
                                                            {0.7, 0.2505, 0.2636},
                                                            {0.9, 0.2576, 0.2628},
                                                            {1.0, 0.2546, 0.2523}}})
    for (const bool ball : {true, false}) {
      CAPTURE(eps, ball);
      RollingGeometry geometry = geometry_of(ball);
      const double x = 1e-3, deepest = 2 * eps * x;
      geometry.clearance = 2 * (x - deepest);
      const Vector6 N = RollingBearingLaw(geometry, 0).calc(along(0, x), Vector6::Zero()).N;
      const double full = 9 * 3 * std::pow(deepest, geometry.exponent);
      CHECK_THAT(N[0] / full, WithinAbs(ball ? point : line, 1.1e-4));  // four digits, and places 2 degrees apart
      CHECK_THAT(N[1], WithinAbs(0, 1e-12 * full));
    }
}

TEST_CASE("without clearance the most loaded element has 4.37 of balls, 4.08 of rollers, of the mean force") {
  for (const bool ball : {true, false}) {
    const RollingGeometry geometry = geometry_of(ball);
    const double x = 1e-3, most = 3 * std::pow(x, geometry.exponent);
    const double force = RollingBearingLaw(geometry, 0).calc(along(0, x), Vector6::Zero()).N[0];
    CHECK_THAT(most * 9 / force, WithinAbs(ball ? 4.37 : 4.08, 0.005));  // R. Stribeck, 1901; A. Palmgren
  }
}

TEST_CASE("the contact angle of balls grows under axial load, and the stiffness with it") {
  RollingGeometry geometry = geometry_of(true);
  geometry.contact_angle = 0.4;
  const RollingBearingLaw law(geometry, 0);
  const double z = 0.02, A = 0.7, K = 3, Z = 9;
  const double p = A * std::cos(0.4), q = A * std::sin(0.4) + z, l = std::hypot(p, q), delta = l - A, sine = q / l;
  const BearingLaw::Force force = law.calc(along(2, z), Vector6::Zero());
  CHECK_THAT(force.N[2], WithinRel(Z * K * std::pow(delta, 1.5) * sine, 1e-12));
  const double stiffness =
      Z * K * (1.5 * std::sqrt(delta) * sine * sine + std::pow(delta, 1.5) * (1 - sine * sine) / l);
  CHECK_THAT(force.by_e(2, 2), WithinRel(stiffness, 1e-12));
  CHECK(law.calc(along(2, -z), Vector6::Zero()).N.isZero(0));  // one direction alone
}

TEST_CASE("axial play of a deep groove bearing follows from its clearance") {
  RollingGeometry geometry = geometry_of(true);
  geometry.clearance = 0.02;
  const RollingBearingLaw law(geometry, 0);
  const double A = 0.7, play = std::sqrt(A * A - (A - 0.01) * (A - 0.01));
  for (const double side : {1.0, -1.0}) {
    CHECK(law.calc(along(2, side * play * (1 - 1e-9)), Vector6::Zero()).N.isZero(0));
    CHECK(side * law.calc(along(2, side * play * (1 + 1e-6)), Vector6::Zero()).N[2] > 0);
  }
}

TEST_CASE("a preload acts at the position as drawn") {
  for (const bool ball : {true, false}) {
    RollingGeometry geometry = geometry_of(ball);
    geometry.contact_angle = 0.3;
    for (const double clearance : {0.0, -0.01, 0.01}) {
      geometry.clearance = clearance;
      const RollingBearingLaw law(geometry, 0.05);
      CHECK_THAT(law.calc(Vector6::Zero(), Vector6::Zero()).N[2], WithinRel(0.05, 1e-9));
    }
  }
}

TEST_CASE("rollers of any contact angle resist a tilt along their length") {
  // An interference of 1 loads all nine slices: the stiffness is n Z K (L^2/12) (1 - 1/81)/2.
  RollingGeometry geometry = geometry_of(false);
  geometry.roller_length = 0.3;
  geometry.clearance = -2;
  const RollingBearingLaw law(geometry, 0);
  const double slope = 9 * 3 * 1.1;
  const double second_moment = 0.3 * 0.3 / 12 * (1 - 1.0 / 81);
  CHECK_THAT(law.calc(Vector6::Zero(), Vector6::Zero()).by_e(3, 3), WithinRel(slope * second_moment / 2, 1e-12));
}

TEST_CASE("Hertz: spheres have the closed form, ellipses the published displacements") {
  const double R = 0.01, modulus = 2.3e11;
  CHECK_THAT(hertz_constant(R, R, modulus), WithinRel(2.0 / 3 * modulus * std::sqrt(R), 1e-9));
  // T. A. Harris, Rolling Bearing Analysis, table of dimensionless contact parameters: F(rho), delta*.
  for (const auto& [difference, displacement] : std::array<std::pair<double, double>, 6>{{{0.3204, 0.9761},
                                                                                          {0.5916, 0.9077},
                                                                                          {0.7332, 0.8394},
                                                                                          {0.90999, 0.6636},
                                                                                          {0.97290, 0.4960},
                                                                                          {0.990902, 0.3745}}}) {
    CAPTURE(difference);
    const double sum = 100, R_x = 2 / (sum * (1 + difference)), R_y = 2 / (sum * (1 - difference));
    const double K = hertz_constant(R_x, R_y, modulus);
    CHECK_THAT(std::pow(modulus * sum / 3 / K, 2.0 / 3) * 2 / sum, WithinRel(displacement, 3e-4));
    CHECK_THAT(hertz_constant(R_y, R_x, modulus), WithinRel(K, 1e-12));
  }
}

TEST_CASE("a cage turns the stiffness with the shaft, by the period of an element") {
  RollingGeometry geometry = geometry_of(true);
  geometry.discrete = true;
  geometry.cage_ratio = 0.4;
  const RollingBearingLaw law(geometry, 0);
  const auto force_at = [&](double angle) {
    Vector6 e = along(0, 1e-3);
    e[5] = angle;
    return law.calc(e, Vector6::Zero()).N;
  };
  const double period = 2 * std::numbers::pi / 9 / 0.4;
  CHECK_THAT(force_at(period)[0], WithinRel(force_at(0)[0], 1e-12));
  CHECK(std::abs(force_at(0.5 * period)[0] / force_at(0)[0] - 1) > 1e-3);
  CHECK(std::abs(force_at(0.25 * period)[5]) > 0);
}
