// The order of the scheme on a model with an algebraic unknown: a pendulum held by two springs in series without mass
// between them (tests/support/series_strut.hpp). Reference: the equation of its angle, with the springs' balance solved
// for at each evaluation, by the classical Runge-Kutta method. And the same model with the unknown eliminated.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "tests/support/orifices_in_series.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/series_strut.hpp"

using namespace bielle::mechanism;
using bielle::test::OrificesInSeries;
using bielle::test::SeriesStrut;

namespace test_algebraic_unknown {
namespace {

constexpr double mass = 2, inertia = 0.05, arm = 0.8, gravity = 9.81;
constexpr SeriesStrut::Law law{400, 3e4, 900, 5, 0.7};
const Vector3 anchor(0.9, 0.7, 0);

/// The pendulum's node stands in its centre of mass; the strut pulls there.
struct Pendulum {
  MechanismFile file;
  std::unique_ptr<System> system;
  explicit Pendulum(bool eliminated)
      : file(read_mechanism_text(R"yaml(
gravity: [0, -9.81, 0]
nodes: {anchor: {position: [0.9, 0.7, 0], fixed: true}, bob: {position: [0.8, 0, 0], velocity: [0, 1.6, 0], angular_velocity: [0, 0, 2]}}
elements: {bob: {type: rigid_body, node: bob, mass: 2, inertia: [0.05, 0.05, 0.05]}}
joints: {pivot: {type: spherical, nodes: [ground, bob], position: [0, 0, 0]}}
)yaml",
                                 "pendulum.yaml")) {
    file.model.add(std::make_unique<SeriesStrut>("strut", *file.model.find_node("anchor"), *file.model.find_node("bob"),
                                                 law, eliminated),
                   Entry{Section::elements, "strut"}, Recorded::no);
    system = std::make_unique<System>(file.model);
  }
};

/// Angle and its rate.
class Reference {
 public:
  void advance(double h, int steps) {
    const double e = h / steps;
    for (int k = 0; k < steps; ++k) {
      const Vector2 k1 = rate(z_), k2 = rate(z_ + e / 2 * k1), k3 = rate(z_ + e / 2 * k2), k4 = rate(z_ + e * k3);
      z_ += e / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
  Vector3 x() const { return arm * radial(z_); }
  Vector3 v() const { return arm * z_[1] * tangential(z_); }
  double y() const { return elongation(z_); }
  /// Returns the force of the pivot on the body.
  Vector3 force() const {
    const Vector3 a = arm * (rate(z_)[1] * tangential(z_) - z_[1] * z_[1] * radial(z_));
    return mass * a + Vector3(0, mass * gravity, 0) + law.force(y()) * line(z_).normalized();
  }

 private:
  using Vector2 = Eigen::Vector2d;
  static Vector3 radial(const Vector2& z) { return {std::cos(z[0]), std::sin(z[0]), 0}; }
  static Vector3 tangential(const Vector2& z) { return {-std::sin(z[0]), std::cos(z[0]), 0}; }
  static Vector3 line(const Vector2& z) { return arm * radial(z) - anchor; }
  static double lengthening(const Vector2& z) { return arm * line(z).normalized().dot(tangential(z)); }  // per rad
  static double elongation(const Vector2& z) { return law.solve(line(z).norm(), lengthening(z) * z[1]); }
  static Vector2 rate(const Vector2& z) {
    const double moment = -mass * gravity * arm * std::cos(z[0]) - law.force(elongation(z)) * lengthening(z);
    return {z[1], moment / (inertia + mass * arm * arm)};
  }
  Vector2 z_{0, 2};
};

struct Errors {
  double x = 0, v = 0, lambda = 0, y = 0;
};

/// Returns the largest errors over all steps of 0.5 s, of h, and of `factor` h after the first 0.2 s.
Errors largest_errors(const Scheme& scheme, ConstraintForm form, double h, double factor) {
  const Pendulum model(false);
  TimeIntegration integration(*model.system, model.file.model.environment, scheme, model.system->start(0), form);
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
      errors.y = std::max(errors.y, std::abs(state.first_order[0] - reference.y()));
    }
  };
  go(h, 0.2);
  go(factor * h, 0.3);
  return errors;
}

struct Case {
  const char* name;
  Scheme scheme;
  ConstraintForm form;
};
/// With Newmark's rule velocities are corrected in every step.
const Case cases[] = {{"position", Scheme::generalized_alpha(0.8), ConstraintForm::position},
                      {"corrected", Scheme::newmark(), ConstraintForm::corrected},
                      {"stabilised", Scheme::generalized_alpha(0.8), ConstraintForm::stabilised}};

}  // namespace

TEST_CASE("with an algebraic unknown all is of order 2 from the first step and across a change of the step") {
  for (const Case& each : cases)
    for (const double factor : {0.5, 2.0}) {
      double h = 4e-3;
      Errors coarse = largest_errors(each.scheme, each.form, h, factor);
      for (int halving = 0; halving < 4; ++halving) {
        h /= 2;
        const Errors fine = largest_errors(each.scheme, each.form, h, factor);
        INFO(each.name << ", factor " << factor << ", h = " << h << ": x " << coarse.x << " -> " << fine.x << ", v "
                       << coarse.v << " -> " << fine.v << ", lambda " << coarse.lambda << " -> " << fine.lambda
                       << ", y " << coarse.y << " -> " << fine.y);
        CHECK(std::log2(coarse.x / fine.x) == Approx(2).margin(0.1));
        CHECK(std::log2(coarse.v / fine.v) == Approx(2).margin(0.1));
        CHECK(std::log2(coarse.lambda / fine.lambda) == Approx(2).margin(0.15));
        CHECK(std::log2(coarse.y / fine.y) == Approx(2).margin(0.1));
        coarse = fine;
      }
    }
}

TEST_CASE(
    "an algebraic unknown moves a model as its elimination does, and its equation holds at the end of each step") {
  for (const Case& each : cases) {
    CAPTURE(each.name);
    const Pendulum with(false), without(true);
    const auto begin = [&](const Pendulum& model) {
      return TimeIntegration(*model.system, model.file.model.environment, each.scheme, model.system->start(0),
                             each.form);
    };
    TimeIntegration one = begin(with), other = begin(without);
    constexpr double h = 2e-3;
    one.start(h);
    other.start(h);
    double y_error = 0, x_error = 0, lambda_error = 0;
    for (int k = 0; k < 250; ++k) {
      one.step(h);
      other.step(h);
      const NodeState &bob = one.state().nodes.back(), &expected = other.state().nodes.back();
      const Vector3 s = bob.x - anchor;
      y_error =
          std::max(y_error, std::abs(one.state().first_order[0] - law.solve(s.norm(), s.normalized().dot(bob.v))));
      x_error = std::max(x_error, (bob.x - expected.x).norm());
      lambda_error = std::max(lambda_error, (one.state().multiplier - other.state().multiplier).norm());
    }
    // Newton's tolerance, 1e-9 of the forces, adds up over the steps.
    CHECK(x_error < 1e-9);
    CHECK(lambda_error < 1e-7);
    // Corrected velocities differ from those of the step's equations, by h^2 B c of some m/s.
    CHECK(y_error < (each.form == ConstraintForm::corrected ? 1e-7 : 1e-11));
  }
}

TEST_CASE("a chamber empties through a junction without volume: both pressures are of order 2") {
  constexpr double p = 1e7, end = 0.032;
  const OrificesInSeries::Law orifices{1e-12, 1e-7, 2e-7, 1e2};
  MechanismFile file = read_mechanism_text(R"yaml(
nodes: {mass: {position: [0, 0, 0]}}
elements: {mass: {type: rigid_body, node: mass, mass: 1, inertia: [1, 1, 1]}}
)yaml",
                                           "chamber.yaml");
  file.model.add(std::make_unique<OrificesInSeries>("chamber", orifices, p, 0), Entry{Section::elements, "chamber"},
                 Recorded::no);
  const System system(file.model);
  const double root = std::sqrt(p) - 2e-7 / std::sqrt(5.0) / (2 * orifices.capacity) * end;
  const auto error = [&](double h) -> Eigen::VectorXd {
    TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), system.start(0));
    integration.start(h);
    for (long k = 0; k < std::lround(end / h); ++k) integration.step(h);
    return integration.state().first_order - root * root * Eigen::Vector2d(1, 0.2);
  };
  bielle::test::check_second_order(error, 4e-3, 4);
}

}  // namespace test_algebraic_unknown
