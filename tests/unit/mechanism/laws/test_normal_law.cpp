// The normal force of a contact: its derivatives, and the restitution of impacts.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/laws/normal_law.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using Catch::WithinAbs;
using Catch::WithinRel;

TEST_CASE("the force has the derivatives that it says") {
  NormalLaw law;
  law.stiffness = 3e3;
  for (const double p : {0.01, 0.3, 2.0})
    for (const double rate : {-0.2, 0.0, 0.7}) {
      const double d = 1.1;
      const NormalLaw::Force force = law.force(p, rate, d);
      const auto slope = [](auto f, double h) { return bielle::test::derivative(f, h); };
      CHECK_THAT(slope([&](double s) { return law.force(p + s, rate, d).F; }, 0.02 * p), WithinRel(force.by_p, 1e-9));
      CHECK_THAT(slope([&](double s) { return law.force(p, rate + s, d).F; }, 0.01), WithinRel(force.by_rate, 1e-9));
      CHECK_THAT(slope([&](double s) { return law.energy(p + s); }, 0.02 * p), WithinRel(law.force(p, 0, d).F, 1e-9));
    }
}

TEST_CASE("bodies that part pull by nothing") {
  NormalLaw law;
  law.stiffness = 3e3;
  CHECK(law.force(0.1, -2, 0.6).F == 0);
  CHECK(law.force(0, 1, 0.6).F == 0);
  CHECK(law.force(-0.1, 1, 0.6).F == 0);
}

TEST_CASE("restitution and damping are inverse to each other") {
  for (const double e : {0.05, 0.3, 0.5, 0.8, 0.95, 0.999})
    CHECK_THAT(restitution_for_damping(damping_for_restitution(e)), WithinRel(e, 1e-9));
  CHECK(damping_for_restitution(1) == 0);
  CHECK(restitution_for_damping(0) == 1);
  // Transition from the series to the root.
  CHECK_THAT(restitution_for_damping(1.0001e-4), WithinAbs(restitution_for_damping(0.9999e-4), 2e-8));
}

TEST_CASE("a mass leaves an impact with the restitution of the closed form, whatever stiffness, exponent and mass") {
  for (const double exponent : {1.0, 1.5, 2.2})
    for (const double d : {0.05, 0.4, 2.0}) {
      NormalLaw law;
      law.stiffness = 5e4;
      law.exponent = exponent;
      const double mass = 0.3, speed = 1.3;
      // p' = v, v' = -F/m until p returns to zero.
      using State = Eigen::Vector2d;
      const auto rate = [&](const State& z) -> State { return {z[1], -law.force(z[0], z[1], d).F / mass}; };
      State z(1e-12, speed), before = z;
      const double h = 2e-6;
      while (z[0] > 0) {
        before = z;
        bielle::test::advance_by_runge_kutta(z, h, 1, rate);
      }
      CAPTURE(exponent, d);
      CHECK_THAT(-before[1] / speed, WithinAbs(restitution_for_damping(d * speed), 1e-5));
    }
}
