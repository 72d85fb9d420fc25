// A car in a steady turn against the linear bicycle model.
//
// Yaw rate r = V delta/(l + K V^2), K = m/l (b/C_f - a/C_r), with the distances a, b of the axles from the centre of
// mass. The lateral force acts at the pneumatic trail t behind each contact, so that a - t and b + t take their places.
// Reference: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), section 1.3.
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

namespace test_steady_turn {

using bielle::mechanism::Session;

constexpr double m = 1000, a = 1.2, b = 1.5, C_f = 60e3, C_r = 80e3, delta = 1e-3;

std::string car(double V, double trail) {
  std::string text = fmt::format(R"yaml(
nodes:
  chassis: {{position: [0, 0, 0.3], velocity: [{0:.17g}, 0, 0]}}
  front: {{position: [1.2, 0, 0.3], velocity: [{0:.17g}, 0, 0], angular_velocity: [{1:.17g}, {2:.17g}, 0]}}
  rear: {{position: [-1.5, 0, 0.3], velocity: [{0:.17g}, 0, 0], angular_velocity: [0, {3:.17g}, 0]}}
elements:
  body: {{type: rigid_body, node: chassis, mass: 1000, inertia: [1500, 1500, 1500]}}
  front: {{type: rigid_body, node: front, mass: 1e-3, inertia: [0.1, 0.1, 0.1]}}
  rear: {{type: rigid_body, node: rear, mass: 1e-3, inertia: [0.1, 0.1, 0.1]}}
joints:
  plane: {{type: planar, nodes: [ground, chassis], axis: [0, 0, 1]}}
)yaml",
                                 V, -std::sin(delta) * V * std::cos(delta) / 0.31,
                                 std::cos(delta) * V * std::cos(delta) / 0.31, V / 0.31);
  for (const auto& [name, angle, C] :
       {std::tuple<std::string, double, double>{"front", delta, C_f}, {"rear", 0.0, C_r}})
    text += fmt::format(R"yaml(
  {0}_axle: {{type: hinge, nodes: [chassis, {0}], axis: [{1:.17g}, {2:.17g}, 0]}}
  {0}_tyre: {{type: tyre, nodes: [ground, {0}], normal: [0, 0, 1], position: [0, 0, 0], axis: [{1:.17g}, {2:.17g}, 0],
    radius: 0.315, stiffness: 2e5,
    slip: {{longitudinal: 1e5, lateral: {3}, friction: 1e6, relaxation: 0.3, trail: {4}}}}}
)yaml",
                        name, -std::sin(angle), std::cos(angle), C, trail);
  return text;
}

TEST_CASE("a car turns as the bicycle model says, at any speed and with any trail") {
  for (const double trail : {0.0, 0.05})
    for (const double speed : {5.0, 20.0, 40.0}) {
      CAPTURE(trail, speed);
      bielle::test::move_to(car(speed, trail), 2e-3, 5, [&](const Session& session) {
        const auto& chassis = session.node("chassis");
        const double l = a + b, V = (chassis.R.transpose() * chassis.v).x();
        const double K = m / l * ((b + trail) / C_f - (a - trail) / C_r);
        CHECK(V > 0.99 * speed);
        CHECK(chassis.Omega.z() == Approx(V * delta / (l + K * V * V)).epsilon(2e-4));
      });
    }
}

TEST_CASE("a car that oversteers is unstable beyond its critical speed") {
  // With the tyres exchanged K < 0: the critical speed is sqrt(-l/K).
  std::string text = car(20, 0), from = "lateral: 60000", to = "lateral: 200000";
  text.replace(text.find(from), from.size(), to);
  const double l = a + b, K = m / l * (b / 200e3 - a / C_r), critical = std::sqrt(-l / K);
  CHECK(critical == Approx(31.2).epsilon(5e-3));
  const auto yaw_rate = [&](double V, double end) {
    std::string car_at_speed = car(V, 0);
    car_at_speed.replace(car_at_speed.find(from), from.size(), to);
    double rate = 0;
    bielle::test::move_to(car_at_speed, 2e-3, end,
                          [&](const Session& session) { rate = session.node("chassis").Omega.z(); });
    return rate;
  };
  CHECK(yaw_rate(25, 6) == Approx(yaw_rate(25, 8)).epsilon(2e-3));
  CHECK(yaw_rate(38, 2) > 2 * yaw_rate(38, 1));
}

}  // namespace test_steady_turn
