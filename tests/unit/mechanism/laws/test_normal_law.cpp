// The normal force of a contact: its derivatives, and the restitution of impacts.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/laws/normal_law.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using Catch::WithinAbs;
using Catch::WithinRel;

TEST_CASE("the force is that of Hunt and Crossley, with the derivatives that it says") {
  NormalLaw law;
  law.stiffness = 3e3;
  for (const double p : {0.01, 0.3, 2.0})
    for (const double rate : {-0.2, 0.0, 0.7}) {
      const double d = 1.1;
      const NormalLaw::Force force = law.force(p, rate, d);
      CHECK_THAT(force.F, WithinRel(3e3 * std::pow(p, 1.5) * (1 + d * rate), 1e-14));
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
      const double stiffness = 5e4, mass = 0.3, speed = 1.3;
      // p' = v, v' = -k p^n (1 + d v)/m until p returns to zero; bodies do not pull.
      using State = Eigen::Vector2d;
      const auto rate = [&](const State& z) -> State {
        const double F = stiffness * std::pow(std::max(z[0], 0.0), exponent) * std::max(0.0, 1 + d * z[1]);
        return {z[1], -F / mass};
      };
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

TEST_CASE("impacts slower than the slowest one are damped as this one") {
  NormalLaw law;
  law.restitution = 0.6;
  law.slowest_impact = 0.02;
  const double delta = damping_for_restitution(0.6);
  CHECK_THAT(law.damping_after(0.5), WithinRel(delta / 0.5, 1e-15));
  CHECK_THAT(law.damping_after(0.021), WithinRel(delta / 0.021, 1e-15));
  for (const double speed : {0.0, 1e-9, 0.019}) CHECK_THAT(law.damping_after(speed), WithinRel(delta / 0.02, 1e-15));
  CHECK(NormalLaw().slowest_impact == 1e-3);  // the manual's
  law.restitution = 0;
  law.damping = 7;
  CHECK(law.damping_after(1e-9) == 7);
}
