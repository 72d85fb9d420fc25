// The order of the scheme on a model with a first-order unknown: a pendulum held by a spring and a damper in series
// (tests/support/maxwell_strut.hpp). Reference: its two equations, for the angle and the tension, by the classical
// Runge-Kutta method.
#include <catch2/catch.hpp>

#include "tests/order/self_convergence.hpp"
#include "tests/support/maxwell_strut.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace test_first_order_unknown {
namespace {

constexpr double mass = 2, inertia = 0.05, arm = 0.8, gravity = 9.81;
constexpr double stiffness = 400, relaxation = 0.05, tension_at_start = 30;
const Vector3 anchor(0.9, 0.7, 0);

/// The pendulum's node stands in its centre of mass; the strut pulls there.
struct Pendulum {
  MechanismFile file;
  std::unique_ptr<System> system;
  Pendulum()
      : file(read_mechanism_text(R"yaml(
gravity: [0, -9.81, 0]
nodes: {anchor: {position: [0.9, 0.7, 0], fixed: true}, bob: {position: [0.8, 0, 0], velocity: [0, 1.6, 0], angular_velocity: [0, 0, 2]}}
elements: {bob: {type: rigid_body, node: bob, mass: 2, inertia: [0.05, 0.05, 0.05]}}
joints: {pivot: {type: spherical, nodes: [ground, bob], position: [0, 0, 0]}}
)yaml",
                                 "pendulum.yaml")) {
    file.model.add(std::make_unique<bielle::test::MaxwellStrut>("strut", *file.model.find_node("anchor"),
                                                                *file.model.find_node("bob"), stiffness, relaxation,
                                                                tension_at_start),
                   Entry{Section::elements, "strut"}, Recorded::no);
    system = std::make_unique<System>(file.model);
  }
};

/// Angle, its rate, and the tension.
class Reference {
 public:
  void advance(double h, int steps) {
    const double e = h / steps;
    for (int k = 0; k < steps; ++k) {
      const Vector3 k1 = rate(z_), k2 = rate(z_ + e / 2 * k1), k3 = rate(z_ + e / 2 * k2), k4 = rate(z_ + e * k3);
      z_ += e / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
  Vector3 x() const { return arm * radial(z_); }
  Vector3 v() const { return arm * z_[1] * tangential(z_); }
  double tension() const { return z_[2]; }
  /// Returns the force of the pivot on the body.
  Vector3 force() const {
    const Vector3 a = arm * (rate(z_)[1] * tangential(z_) - z_[1] * z_[1] * radial(z_));
    return mass * a + Vector3(0, mass * gravity, 0) + z_[2] * direction(z_);
  }

 private:
  static Vector3 radial(const Vector3& z) { return {std::cos(z[0]), std::sin(z[0]), 0}; }
  static Vector3 tangential(const Vector3& z) { return {-std::sin(z[0]), std::cos(z[0]), 0}; }
  static Vector3 direction(const Vector3& z) { return (arm * radial(z) - anchor).normalized(); }
  static Vector3 rate(const Vector3& z) {
    const double lengthening = arm * direction(z).dot(tangential(z));  // per rad
    const double moment = -mass * gravity * arm * std::cos(z[0]) - z[2] * lengthening;
    return {z[1], moment / (inertia + mass * arm * arm), stiffness * lengthening * z[1] - z[2] / relaxation};
  }
  Vector3 z_{0, 2, tension_at_start};
};

struct Errors {
  double x = 0, v = 0, lambda = 0, tension = 0;
};

/// Returns the largest errors over all steps of 0.5 s, of h, and of `factor` h after the first 0.2 s.
Errors largest_errors(ConstraintForm form, double h, double factor) {
  const Pendulum model;
  TimeIntegration integration(*model.system, model.file.model.environment, Scheme::generalized_alpha(0.8),
                              model.system->start(0), form);
  Reference reference;
  Errors errors;
  integration.start(h);
  const auto go = [&](double size, double span) {
    integration.change_step(size);
    for (long k = 0; k < std::lround(span / size); ++k) {
      integration.step(size);
      reference.advance(size, 10);
      const State& state = integration.state();
      const NodeState& bob = state.nodes.back();
      errors.x = std::max(errors.x, (bob.x - reference.x()).norm());
      errors.v = std::max(errors.v, (bob.v - reference.v()).norm());
      errors.lambda = std::max(errors.lambda, (-state.multiplier - reference.force()).norm());
      errors.tension = std::max(errors.tension, std::abs(state.first_order[0] - reference.tension()));
    }
  };
  go(h, 0.2);
  go(factor * h, 0.3);
  return errors;
}

}  // namespace

TEST_CASE("with a first-order unknown all is of order 2 from the first step and across a change of the step") {
  for (const ConstraintForm form : {ConstraintForm::position, ConstraintForm::stabilised})
    for (const double factor : {0.5, 2.0}) {
      double h = 4e-3;
      Errors coarse = largest_errors(form, h, factor);
      for (int halving = 0; halving < 4; ++halving) {
        h /= 2;
        const Errors fine = largest_errors(form, h, factor);
        INFO((form == ConstraintForm::stabilised ? "stabilised" : "index 3")
             << ", factor " << factor << ", h = " << h << ": x " << coarse.x << " -> " << fine.x << ", v " << coarse.v
             << " -> " << fine.v << ", lambda " << coarse.lambda << " -> " << fine.lambda << ", tension "
             << coarse.tension << " -> " << fine.tension);
        CHECK(std::log2(coarse.x / fine.x) == Approx(2).margin(0.1));
        CHECK(std::log2(coarse.v / fine.v) == Approx(2).margin(0.1));
        CHECK(std::log2(coarse.lambda / fine.lambda) == Approx(2).margin(0.15));
        CHECK(std::log2(coarse.tension / fine.tension) == Approx(2).margin(0.1));
        coarse = fine;
      }
    }
}

}  // namespace test_first_order_unknown
