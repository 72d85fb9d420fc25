// Steady slip of a tyre against the closed forms of the brush model and of the magic formula.
//
// Reference: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), section 3.2: F = mu N (1 - (1 - psi)^3), psi =
// C sigma/(3 mu N), sigma = v/V_r (theoretical slip); M_z = -C sigma t_0 (1 - psi)^3.
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/benchmarks/tyres/tyre_rig.hpp"
#include "tests/support/second_order.hpp"

namespace test_slip_forces {

using bielle::mechanism::Session;
using bielle::test::move_to;
using bielle::test::TyreRig;
using Eigen::Vector2d;

constexpr double C_x = 30e3, C_y = 24e3, mu = 0.9;
const std::string slip_keys = "longitudinal: 30e3, lateral: 24e3, friction: 0.9, relaxation: [0.2, 0.4]";

struct Steady {
  Vector2d force;
  double moment = 0;
};

/// Moves the rig until the slip is steady: fifty relaxation lengths.
Steady steady(const TyreRig& rig) {
  Steady found;
  move_to(rig.text(), 2e-3, 2, [&](const Session& session) {
    const std::vector<double> force = session.read("joints/tyre/tyre_force");
    found = {{force[0], force[1]}, session.read("joints/tyre/aligning_moment")[0]};
    CHECK(session.read("joints/tyre/normal_force")[0] == Approx(rig.load()).epsilon(1e-9));
  });
  return found;
}

double brush(double rho) { return rho < 3 ? rho * (1 - rho / 3 + rho * rho / 27) : 1; }

TEST_CASE("a tyre at an angle has the lateral force and the moment of the brush model") {
  for (const double angle : {0.01, -0.06, 0.15, 0.4}) {
    CAPTURE(angle);
    TyreRig rig;
    rig.angle = angle;
    rig.tyre = "slip: {" + slip_keys + ", trail: 0.03}";
    const Steady found = steady(rig);
    const double N = rig.load(), s = C_y * std::tan(angle), psi = std::min(1.0, std::abs(s) / (3 * mu * N));
    CHECK(std::abs(found.force.x()) < 1e-6 * N);
    CHECK(found.force.y() == Approx(std::copysign(mu * N * (1 - std::pow(1 - psi, 3)), angle)).epsilon(1e-7));
    CHECK(found.moment == Approx(-0.03 * s * std::pow(1 - psi, 3)).epsilon(1e-4).margin(1e-6));
  }
}

TEST_CASE("a tyre that is driven or braked has the longitudinal force of the brush model, up to full sliding") {
  for (const double slip : {0.02, -0.03, 0.08, 1.0, -0.5}) {
    CAPTURE(slip);
    TyreRig rig;
    rig.spin = rig.speed / (1 + slip) / rig.rolling_radius;
    rig.tyre = "slip: {" + slip_keys + "}";
    const double N = rig.load(), rho = C_x * std::abs(slip) / (mu * N);
    const Steady found = steady(rig);
    CHECK(found.force.x() == Approx(-std::copysign(mu * N * brush(rho), slip)).epsilon(1e-7));
    CHECK(std::abs(found.force.y()) < 1e-9 * N);
  }
}

TEST_CASE("a tyre with combined slip pushes against its slip, within the circle of friction") {
  for (const double angle : {0.03, 0.2})
    for (const double slip : {0.02, -0.2}) {
      CAPTURE(angle, slip);
      TyreRig rig;
      rig.angle = angle;
      const double V_r = rig.speed * std::cos(angle) / (1 + slip), N = rig.load();
      rig.spin = V_r / rig.rolling_radius;
      rig.tyre = "slip: {" + slip_keys + "}";
      const Vector2d s(C_x * slip, -C_y * rig.speed * std::sin(angle) / V_r);
      const Steady found = steady(rig);
      const Vector2d expected = -mu * N * brush(s.norm() / (mu * N)) * s.normalized();
      CHECK((found.force - expected).norm() < 1e-7 * N);
      CHECK(found.force.norm() <= mu * N * (1 + 1e-9));
    }
}

TEST_CASE("a locked wheel slides with its friction against its velocity") {
  TyreRig rig;
  rig.angle = 0.3;
  rig.spin = 1e-9;
  rig.tyre = "slip: {" + slip_keys + "}";
  const Vector2d s(C_x * std::cos(0.3), -C_y * std::sin(0.3));
  CHECK((steady(rig).force + mu * rig.load() * s.normalized()).norm() < 1e-6 * rig.load());
}

TEST_CASE("the magic formula has its peak mu N and falls beyond it") {
  // F = mu N sin(C atan(B rho - E (B rho - atan(B rho)))), B = 1/C.
  const double C = 1.6, E = -0.5;
  const auto formula = [&](double rho) {
    const double x = rho / C;
    return std::sin(C * std::atan(x - E * (x - std::atan(x))));
  };
  double most = 0;
  for (const double slip : {0.01, 0.05, 0.1, 0.12, 0.2, 0.4, 1.0}) {
    CAPTURE(slip);
    TyreRig rig;
    rig.spin = rig.speed / (1 + slip) / rig.rolling_radius;
    rig.tyre = "slip: {" + slip_keys + ", shape: 1.6, curvature: -0.5}";
    const double N = rig.load();
    const Steady found = steady(rig);
    CHECK(found.force.x() == Approx(-mu * N * formula(C_x * slip / (mu * N))).epsilon(1e-7));
    most = std::max(most, -found.force.x());
  }
  CHECK(most > 0.99 * mu * 2000);
  CHECK(most <= mu * 2000 * (1 + 1e-9));
  CHECK(formula(C_x / (mu * 2000)) < 0.9);
}

TEST_CASE("the magic formula holds before and beyond its peak, near or far, and without a peak") {
  struct Shape {
    double C, E;
  };
  for (const auto [C, E] : {Shape{1, 0}, {1, 1}, {1.05, 0.5}, {1.3, -3}, {1.9, 0.9}})
    for (const double slip : {0.03, 0.3, 2.0}) {
      CAPTURE(C, E, slip);
      TyreRig rig;
      rig.spin = rig.speed / (1 + slip) / rig.rolling_radius;
      rig.tyre = fmt::format("slip: {{{}, shape: {}, curvature: {}}}", slip_keys, C, E);
      const double N = rig.load(), x = C_x * slip / (mu * N) / C;
      CHECK(steady(rig).force.x() ==
            Approx(-mu * N * std::sin(C * std::atan(x - E * (x - std::atan(x))))).epsilon(1e-7));
    }
}

TEST_CASE("a tyre that rolls freely has no force along the road") {
  TyreRig rig;
  rig.tyre = "slip: {" + slip_keys + ", trail: 0.03, camber: 2e3}";
  const Steady found = steady(rig);
  CHECK(found.force.norm() < 1e-6);
  CHECK(std::abs(found.moment) < 1e-6);
}

TEST_CASE("rolling resistance drags a free wheel by its share of the load") {
  TyreRig rig;
  rig.tyre = "rolling_resistance: 0.015, speed: 1e-3, slip: {" + slip_keys + "}";
  CHECK(steady(rig).force.x() == Approx(-0.015 * rig.load()).epsilon(1e-6));
}

TEST_CASE("camber pushes the tyre to the side to which it leans") {
  for (const double camber : {0.1, -0.1}) {
    TyreRig rig;
    rig.camber = camber;
    rig.tyre = "speed: 1e-4, slip: {longitudinal: 30e3, lateral: 24e3, friction: 1e4, relaxation: 0.3, camber: 2e3}";
    CHECK(steady(rig).force.y() == Approx(-2e3 * std::sin(camber)).epsilon(1e-4));
  }
}

TEST_CASE("slip stiffnesses grow with the load up to the stiffest load") {
  TyreRig rig;
  rig.angle = 0.02;
  rig.tyre = "slip: {" + slip_keys + ", stiffest_load: 3e3}";
  const double w = 2.0 / 3, s = C_y * 2 * w / (1 + w * w) * std::tan(0.02), N = rig.load();
  CHECK(steady(rig).force.y() == Approx(mu * N * brush(s / (mu * N))).epsilon(1e-7));
}

TEST_CASE("the lateral force builds up over the relaxation length, with order two") {
  // F = C tan(angle) (1 - exp(-x/sigma)) of the linear tyre.
  TyreRig rig;
  rig.angle = 1e-3;
  rig.tyre = "slip: {longitudinal: 30e3, lateral: 24e3, friction: 1e6, relaxation: 0.4}";
  const auto error = [&](double h) {
    Eigen::VectorXd left(1);
    move_to(rig.text(), h, 0.04, [&](const Session& session) {
      left[0] = session.read("joints/tyre/tyre_force")[1] -
                C_y * std::tan(1e-3) * -std::expm1(-10 * std::cos(1e-3) * 0.04 / 0.4);
    });
    return left;
  };
  bielle::test::check_second_order(error, 4e-3, 2, 0.2);
}

}  // namespace test_slip_forces
