// Order of the index-3 generalised-alpha scheme on the heavy top of O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory
// 48 (2012) 121: m = 15 kg, J = diag(0.234375, 0.46875, 0.234375) kg m^2 about the centre at (0, 1, 0), spinning at
// (0, 150, -4.61538) rad/s. Reference at t = 1 s: Euler-Poinsot equations in quaternions, DOP853 with rtol 1e-13
// (energy drift below 2e-10 J of 5436 J).
#include <catch2/catch.hpp>

#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

const char* const top = R"yaml(
gravity: [0, 0, -9.81]
nodes: {top: {position: [0, 1, 0], velocity: [4.61538, 0, 0], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}
joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}
)yaml";

const Vector3 x_reference(0.17334396410, 0.64008859207, -0.74849079113);
const Vector3 Omega_reference(-0.822078102, 150, -5.923291348);
const Vector3 force_reference(-517.6007395, -396.8431015, 404.5749252);  // of the pivot on the body

struct Errors {
  double x, Omega, lambda;
};

Errors errors_at_one_second(double rho, double h) {
  const ReadyModel model(top);
  const State state = integrate(model, Scheme::generalized_alpha(rho), h, 1.0);
  const NodeState& node = model.node(state, "top");
  // The joint's frame stays parallel to the inertial axes: its multipliers are B^T lambda of the body, the negative of
  // the force on it.
  const Vector3 force = -state.multiplier;
  return {(node.x - x_reference).norm(), (node.Omega - Omega_reference).norm(), (force - force_reference).norm()};
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

TEST_CASE("the heavy top converges with order 2 in positions, velocities and multipliers over four halvings") {
  double h = 2e-3;
  Errors coarse = errors_at_one_second(0.8, h);
  for (int halving = 0; halving < 4; ++halving) {
    h /= 2;
    const Errors fine = errors_at_one_second(0.8, h);
    INFO("h = " << h);
    // The asymptotic order is 2; at these steps the next term of the error is below 5 %.
    CHECK(order(coarse.x, fine.x) == Approx(2).margin(0.05));
    CHECK(order(coarse.Omega, fine.Omega) == Approx(2).margin(0.05));
    CHECK(order(coarse.lambda, fine.lambda) == Approx(2).margin(0.1));
    coarse = fine;
  }
}

TEST_CASE("the heavy top's errors at h = 1e-3 are those of an independent implementation of the scheme") {
  // Lie-group generalised-alpha, rho = 0.8, index 3, in Python with dense algebra: 7.4243e-3, 1.0399e-1, 8.9008.
  const Errors errors = errors_at_one_second(0.8, 1e-3);
  CHECK(errors.x == Approx(7.4243e-3).epsilon(2e-3));
  CHECK(errors.Omega == Approx(1.0399e-1).epsilon(2e-3));
  CHECK(errors.lambda == Approx(8.9008).epsilon(5e-3));
}

namespace {

/// The top as a body about its fixed point (Euler-Poinsot), by the classical Runge-Kutta method: an independent
/// reference.
class EulerPoinsot {
 public:
  /// Advances by h in `steps` equal steps.
  void advance(double h, int steps) {
    const double e = h / steps;
    for (int k = 0; k < steps; ++k) {
      const Vector3 w1 = acceleration(R_, Omega_);
      const Vector3 O2 = Omega_ + e / 2 * w1;
      const Matrix3 R2 = R_ + e / 2 * R_ * skew(Omega_);
      const Vector3 w2 = acceleration(R2, O2);
      const Vector3 O3 = Omega_ + e / 2 * w2;
      const Matrix3 R3 = R_ + e / 2 * R2 * skew(O2);
      const Vector3 w3 = acceleration(R3, O3);
      const Vector3 O4 = Omega_ + e * w3;
      const Matrix3 R4 = R_ + e * R3 * skew(O3);
      const Vector3 w4 = acceleration(R4, O4);
      R_ += e / 6 * (R_ * skew(Omega_) + 2 * R2 * skew(O2) + 2 * R3 * skew(O3) + R4 * skew(O4));
      Omega_ += e / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
    }
  }
  /// Force of the pivot on the body.
  Vector3 force() const {
    const Vector3 arm(0, 1, 0);
    const Vector3 a = R_ * (acceleration(R_, Omega_).cross(arm) + Omega_.cross(Omega_.cross(arm)));
    return 15 * (a - Vector3(0, 0, -9.81));
  }

 private:
  static Vector3 acceleration(const Matrix3& R, const Vector3& Omega) {
    const Vector3 J(15.234375, 0.46875, 15.234375), arm(0, 1, 0);
    const Vector3 weight = R.transpose() * Vector3(0, 0, -9.81 * 15);
    return (arm.cross(weight) - Omega.cross(J.cwiseProduct(Omega))).cwiseQuotient(J);
  }
  Matrix3 R_ = Matrix3::Identity();
  Vector3 Omega_{0, 150, -4.61538};
};

}  // namespace

TEST_CASE("with corrected start values the multipliers are second order in the transient too") {
  // Largest error over all steps of the first 0.1 s. Without the corrections of A_0 and v_0 it is of first order
  // (M. Arnold, O. Bruls, A. Cardona, Numer. Math. 129 (2015) 149). The transient dies out per step, so that each run
  // is judged at its own steps.
  const ReadyModel model(top);
  const auto largest_error = [&](double h) {
    EulerPoinsot reference;
    double error = 0;
    integrate(model, Scheme::generalized_alpha(0.8), h, 0.1, [&](const State& state) {
      if (state.time > 0) reference.advance(h, 20);
      error = std::max(error, (-state.multiplier - reference.force()).norm());
    });
    return error;
  };
  double h = 5e-4, coarse = largest_error(h);
  for (int halving = 0; halving < 3; ++halving) {
    h /= 2;
    const double fine = largest_error(h);
    INFO("h = " << h << ": " << fine);
    CHECK(order(coarse, fine) == Approx(2).margin(0.1));
    coarse = fine;
  }
}
