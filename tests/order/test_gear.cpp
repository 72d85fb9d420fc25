// The order of the scheme with a constraint on coordinates of two joints, declared before them: an arm that turns and
// a slider on it are geared, so that the slider runs on a spiral.
//
//   phi the angle of the arm, s = k phi the way of the slider, rho = rho_0 + s:
//   (I + J + m rho^2 + m k^2) phi'' + m rho k phi'^2 = -m g (k sin(phi) + rho cos(phi))
//   gear on the slider: m (s'' - rho phi'^2) + m g sin(phi) + lambda ratio = 0,   ratio = -1/k
#include <catch2/catch.hpp>

#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/io/component_table.hpp"
#include "mechanism/joints/joint.hpp"
#include "tests/order/constraint_forms.hpp"
#include "tests/support/coordinate_gear.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using bielle::YamlValue;
using bielle::test::CoordinateGear;

namespace test_gear {
namespace {

constexpr double I = 0.3, J = 0.05, m = 2, g = 9.81, rho_0 = 0.6, k = 0.4, omega_0 = 3;

struct Spiral {
  Model model;
  std::unique_ptr<System> system;
  int slider;
  Spiral() {
    model.environment.gravity = {0, -g, 0};
    Node arm, sliding;
    arm.name = "arm";
    arm.angular_velocity = {0, 0, omega_0};
    sliding.name = "slider";
    sliding.frame.x = {rho_0, 0, 0};
    sliding.velocity = {k * omega_0, rho_0 * omega_0, 0};
    sliding.angular_velocity = arm.angular_velocity;
    model.add_node(arm);
    slider = model.add_node(sliding);
    auto made = std::make_unique<CoordinateGear>("gear", -1 / k);
    CoordinateGear& gear = *made;
    model.add(std::move(made), Entry{Section::elements, "gear"}, Recorded::no);
    const auto entry = [](const char* text) { return YamlValue::parse(text, "spiral.yaml"); };
    read_component(Section::elements, "arm", entry("{type: rigid_body, node: arm, mass: 1, inertia: [0.2, 0.2, 0.3]}"),
                   model);
    read_component(Section::elements, "slider",
                   entry("{type: rigid_body, node: slider, mass: 2, inertia: [0.05, 0.05, 0.05]}"), model);
    read_component(Section::joints, "pivot",
                   entry("{type: hinge, nodes: [ground, arm], axis: [0, 0, 1], position: [0, 0, 0]}"), model);
    read_component(Section::joints, "guide", entry("{type: prismatic, nodes: [arm, slider], axis: [1, 0, 0]}"), model);
    const auto joint = [&](std::size_t member) -> const Joint& {
      return dynamic_cast<const Joint&>(*model.members()[member].component);
    };
    gear.join(joint(3), joint(4));
    system = std::make_unique<System>(model);
  }
};

using Vector2 = Eigen::Vector2d;
Vector2 rate(const Vector2& z) {
  const double phi = z[0], w = z[1], rho = rho_0 + k * phi;
  return {w, -(m * rho * k * w * w + m * g * (k * std::sin(phi) + rho * std::cos(phi))) /
                 (I + J + m * rho * rho + m * k * k)};
}
double gear_force(const Vector2& z) {
  return k * (m * (k * rate(z)[1] - (rho_0 + k * z[0]) * z[1] * z[1]) + m * g * std::sin(z[0]));
}

}  // namespace

TEST_CASE("a gear between coordinates of two joints, declared before them, is of order 2 in the three forms") {
  const Spiral model;
  bielle::test::check_forms_of_order_two(
      {"x", "v", "lambda"}, 8e-3, [&](const bielle::test::FormCase& form, double h) -> std::vector<double> {
        TimeIntegration integration(*model.system, model.model.environment, form.scheme, model.system->start(0),
                                    form.form);
        integration.start(h);
        Vector2 z(0, omega_0);
        std::vector<double> errors(3, 0.0);
        double row = 0;
        VectorX r(model.system->size());
        for (long step = 0; step < std::lround(0.8 / h); ++step) {
          integration.step(h);
          bielle::test::advance_by_runge_kutta(z, h, 10, rate);
          const State& state = integration.state();
          const NodeState& slider = state.nodes[static_cast<std::size_t>(model.slider)];
          const double c = std::cos(z[0]), s = std::sin(z[0]), rho = rho_0 + k * z[0];
          const Vector3 x(rho * c, rho * s, 0), v = z[1] * Vector3(k * c - rho * s, k * s + rho * c, 0);
          errors[0] = std::max(errors[0], (slider.x - x).norm());
          errors[1] = std::max(errors[1], (slider.v - v).norm());
          errors[2] = std::max(errors[2], std::abs(state.multiplier[0] - gear_force(z)));
          model.system->residual(state, model.model.environment, r);
          row = std::max(row, std::abs(r[model.system->dofs()]));
        }
        CHECK(row < 1e-9);  // Newton's tolerance, relative to an angle of some radians
        return errors;
      });
}

}  // namespace test_gear
