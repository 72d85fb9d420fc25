// Laws of friction: their derivatives, their limits, and the power that they take from a motion.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/laws/bristle_step.hpp"
#include "mechanism/laws/friction_law.hpp"
#include "tests/support/finite_difference.hpp"

using bielle::mechanism::BristleStep;
using bielle::mechanism::FrictionLaw;
using bielle::mechanism::Vector3;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

FrictionLaw law() {
  FrictionLaw law;
  law.kinetic = 0.3;
  law.sticking = 0.5;
  law.stribeck_velocity = 0.2;
  law.viscous = 0.1;
  law.velocity = 0.03;
  law.bristle_stiffness = 40;
  law.bristle_damping = 12;
  return law;
}

}  // namespace

TEST_CASE("Stribeck's curve falls from rest to sliding") {
  CHECK(law().level(0).mu == 0.5);
  CHECK_THAT(law().level(0.2).mu, WithinRel(0.3 + 0.2 * std::exp(-1), 1e-15));
  CHECK_THAT(law().level(5).mu, WithinRel(0.3, 1e-15));
  FrictionLaw plain = law();
  plain.stribeck_velocity = 0;
  CHECK(plain.level(0).mu == 0.3);
}

TEST_CASE("slopes are the derivatives of what they belong to, at rest as well") {
  for (const double s : {0.0, 1e-6, 5.9e-4, 6.1e-4, 0.01, 0.05, 0.3, 2.0}) {
    CAPTURE(s);
    const double h = 0.02 * 0.03;
    const auto slope = [&](auto f) { return bielle::test::derivative([&](double d) { return f(s + d); }, h); };
    const auto sliding = law().sliding(s);
    CHECK_THAT(slope([](double x) { return law().sliding(x).h; }), WithinAbs(sliding.slope_over_speed * s, 1e-7));
    CHECK_THAT(slope([](double x) { return law().level(x).mu; }),
               WithinAbs(law().level(s).slope_over_speed * s, 1e-10));
    CHECK_THAT(slope([](double x) { return law().bristle_damping_at(x).mu; }),
               WithinAbs(law().bristle_damping_at(s).slope_over_speed * s, 1e-8));
  }
}

TEST_CASE("regularised friction creeps by the documented speed") {
  FrictionLaw plain;
  plain.kinetic = plain.sticking = 0.4;
  plain.velocity = 1e-3;
  for (const double share : {0.1, 0.5, 0.9, 0.99}) {
    const double v = 1e-3 * std::atanh(share);
    CHECK_THAT(plain.sliding(v).h * v, WithinRel(0.4 * share, 1e-13));
  }
  CHECK_THAT(plain.sliding(1).h, WithinRel(0.4, 1e-15));
}

TEST_CASE("viscous friction is added to the dry one, at rest as well") {
  FrictionLaw wet;
  wet.kinetic = wet.sticking = 0.4;
  wet.velocity = 1e-3;
  wet.viscous = 0.25;
  for (const double v : {0.0, 1e-5, 1e-3, 0.1, 20.0})
    CHECK_THAT(wet.sliding(v).h * v, WithinRel(0.4 * std::tanh(v / 1e-3) + 0.25 * v, 1e-13));
  CHECK_THAT(wet.sliding(0).h, WithinRel(0.4 / 1e-3 + 0.25, 1e-14));
}

// sigma_1(v) v < 4 mu is what bristles need in order to take power for every deflection |z| <= mu/sigma_0.
TEST_CASE("the damping of bristles ends at four times the friction") {
  CHECK(law().bristle_damping_at(0).mu == 12);
  for (const double v : {0.05, 0.1, 1.0}) CHECK(law().bristle_damping_at(v).mu * v < 4 * 0.3);
  CHECK_THAT(law().bristle_damping_at(1e6).mu * 1e6, WithinRel(4 * 0.3, 1e-12));
  // Half way: sigma_1 v = 4 mu gives 1/sqrt(2) of sigma_1.
  CHECK_THAT(law().bristle_damping_at(4 * 0.3 / 12).mu, WithinRel(12 / std::sqrt(2.0), 1e-14));
}

TEST_CASE("bristles take power at any deflection and speed") {
  for (double s = 1e-3; s < 10; s *= 1.7)
    for (const double sign : {1.0, -1.0})
      for (double z = 0; z < 1; z += 0.003) {
        const double mu = law().level(s).mu, v = sign * s;
        const double zdot = v - law().bristle_stiffness * s / mu * z;
        const double lost = law().bristle_stiffness * z * (v - zdot) + law().bristle_damping_at(s).mu * zdot * v;
        CAPTURE(v, z);
        CHECK(lost >= 0);
      }
}

TEST_CASE("a step of bristles is one of the implicit Euler method of their equation") {
  // zdot = v - sigma_0 |v| z/mu(|v|), f = sigma_0 z + sigma_1 zdot + sigma_2 v (C. Canudas de Wit et al., IEEE Trans.
  // Automatic Control 40 (1995) 419), with zdot = (z - z_0)/h, and sigma_1/sqrt(1 + (sigma_1 |v|/(4 mu_k))^2).
  for (const double h : {1e-3, 0.1, 2.0})
    for (const Vector3& v : {Vector3(0, 0, 0), Vector3(0.02, -0.01, 0.03), Vector3(-0.7, 0.4, 1.1)}) {
      const Vector3 before(0.004, 0.009, -0.002);
      const double s = v.norm(), mu = 0.3 + 0.2 * std::exp(-std::pow(s / 0.2, 2));
      const double damping = 12 / std::hypot(1, 12 * s / (4 * 0.3));
      const BristleStep step(law(), before, v, h);
      const Vector3 zdot = (step.z - before) / h, force = 40 * step.z + damping * zdot + 0.1 * v;
      CAPTURE(h, s);
      CHECK((zdot - (v - 40 * s / mu * step.z)).norm() < 1e-12 * (1 + 1 / h));
      CHECK((step.force - force).norm() < 1e-12 * (1 + 12 / h));
      CHECK_THAT(step.stored, WithinAbs(40 * step.z.dot(zdot), 1e-12 * (1 + 1 / h)));
      CHECK_THAT(step.lost, WithinAbs(force.dot(v) - 40 * step.z.dot(zdot), 1e-12 * (1 + 12 / h)));
      CHECK(step.lost >= 0);
    }
}
