// The order of the scheme where a force depends on the reaction of a joint: a pendulum whose bearing, of radius r,
// brakes by mu r |F|. Reference: the equation of its angle, by the classical Runge-Kutta method.
//
//   (I + m l^2) th'' = -m g l cos(th) - mu r |F| tanh(th'/w_0),
//   F = m (-l th'^2 e_r + l th'' e_t) + m g e_y,   |F| depends on th'': one equation, solved for it at each evaluation
#include <catch2/catch.hpp>

#include "mechanism/joints/joint.hpp"
#include "tests/order/constraint_forms.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace test_bearing_friction {
namespace {

constexpr double m = 2, I = 0.05, l = 0.8, g = 9.81, mu_r = 0.15, w_0 = 2, omega_0 = 2;

const std::string bob = R"yaml(
gravity: [0, -9.81, 0]
nodes: {bob: {position: [0.8, 0, 0], velocity: [0, 1.6, 0], angular_velocity: [0, 0, 2]}}
elements: {bob: {type: rigid_body, node: bob, mass: 2, inertia: [0.05, 0.05, 0.05]}}
)yaml";

/// By a formula of the user's, and by the friction of the joint itself: radius 0.05, mu 3, smooth within 0.05 w_0.
const std::string by_formula = bob + R"yaml(
joints: {pivot: {type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0]}}
drives:
  bearing: {joint: pivot, torque: "-0.15*sqrt(pivot.reaction.x^2 + pivot.reaction.y^2)*tanh(pivot.angle.rate/2)"}
)yaml";
const std::string by_joint = bob + R"yaml(
joints: {pivot: {type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0],
                 friction: {coefficient: 3, radius: 0.05, velocity: 0.1}}}
)yaml";

using Vector2 = Eigen::Vector2d;

struct Instant {
  double acceleration;
  Vector2 force;  ///< force of the bearing on the body
};

Instant solve(const Vector2& z) {
  const double c = std::cos(z[0]), s = std::sin(z[0]);
  const Vector2 radial(c, s), tangential(-s, c);
  const auto force = [&](double a) -> Vector2 {
    return m * l * (a * tangential - z[1] * z[1] * radial) + m * g * Vector2(0, 1);
  };
  // Contracts by mu r m l / (I + m l^2) = 0.18 each time.
  double a = 0;
  for (int k = 0; k < 30; ++k) a = (-m * g * l * c - mu_r * force(a).norm() * std::tanh(z[1] / w_0)) / (I + m * l * l);
  return {a, force(a)};
}

Vector2 rate(const Vector2& z) { return {z[1], solve(z).acceleration}; }

Vector2 bearing_force(const ReadyModel& model, const State& state) {
  const auto& joint = dynamic_cast<const Joint&>(*model.file.model.components_named("pivot").front());
  const LocalState local(state, model.system.slots_of(joint), model.environment());
  const Matrix3 axes = state.nodes[0].R * joint.frames().on_first.R;
  return (axes * joint.calc_reaction(local).head<3>()).head<2>();
}

}  // namespace

TEST_CASE("friction on a bearing's reaction is of order 2 in the three forms, in a few iterations each step") {
  ReadyModel mutable_model(GENERATE(by_formula, by_joint));
  const ReadyModel& model = mutable_model;
  REQUIRE(model.system.reads_reactions());
  bielle::test::check_forms_of_order_two(
      {"x", "v", "lambda"}, 8e-3, [&](const bielle::test::FormCase& form, double h) -> std::vector<double> {
        NewtonOptions options;
        options.tangent = Tangent::renewed;
        TimeIntegration integration(model.system, model.environment(), form.scheme, model.system.start(0), form.form,
                                    options);
        integration.start(h);
        Vector2 z(0, omega_0);
        std::vector<double> errors(3, 0.0);
        int most = 0;
        for (long step = 0; step < std::lround(0.64 / h); ++step) {
          most = std::max(most, integration.step(h).iterations);
          bielle::test::advance_by_runge_kutta(z, h, 10, rate);
          const State& state = integration.state();
          const NodeState& bob = model.node(state, "bob");
          const Vector3 radial(std::cos(z[0]), std::sin(z[0]), 0), tangential(-radial.y(), radial.x(), 0);
          errors[0] = std::max(errors[0], (bob.x - l * radial).norm());
          errors[1] = std::max(errors[1], (bob.v - l * z[1] * tangential).norm());
          errors[2] = std::max(errors[2], (bearing_force(model, state) - solve(z).force).norm());
        }
        // Convergence is quadratic: two or three iterations reduce errors of about h^2 to 1e-9.
        CHECK(most <= 3);
        return errors;
      });
}

TEST_CASE("the start of a pendulum with bearing friction has the acceleration and the reaction of its equation") {
  const ReadyModel model(GENERATE(by_formula, by_joint));
  const TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                                    model.system.start(0));
  const Instant expected = solve({0, omega_0});
  CHECK_THAT(model.node(integration.state(), "bob").Omegadot.z(), Catch::WithinRel(expected.acceleration, 1e-10));
  CHECK((bearing_force(model, integration.state()) - expected.force).norm() < 1e-9 * expected.force.norm());
}

}  // namespace test_bearing_friction
