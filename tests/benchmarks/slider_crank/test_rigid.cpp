// A rigid slider-crank against closed forms: crank r = 0.15 m, rod l = 0.30 m, data of the IVP test set's problem
// "crank" (B. Simeon): crank inertia 0.002727 kg m^2 about its pivot, rod 0.151104 kg (uniform, thin), slider 0.075552
// kg. Kinematics: x = r cos a + sqrt(l^2 - r^2 sin^2 a). Torque at constant speed and free motions: Newton and Euler's
// equations of the three bodies (tests/references/slider_crank.py).
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace test_rigid {
namespace {

/// Returns a planar mechanism in space, closed by hinges: redundant constraints are set aside.
std::string slider_crank(const std::string& drives) {
  return R"yaml(
nodes:
  crank: {position: [0, 0, 0], angular_velocity: [0, 0, 150]}
  pin: {position: [0.15, 0, 0]}
  rod: {position: [0.30, 0, 0], velocity: [0, 11.25, 0], angular_velocity: [0, 0, -75]}
  slider: {position: [0.45, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 0.36, inertia: [0.0014, 0.0014, 0.002727], also: [pin]}
  rod: {type: rigid_body, node: rod, mass: 0.151104, inertia: [1e-6, 0.00113328, 0.00113328]}
  slider: {type: point_mass, node: slider, mass: 0.075552}
joints:
  main: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1]}
  big_end: {type: hinge, nodes: [pin, rod], axis: [0, 0, 1], position: [0.15, 0, 0]}
  wrist: {type: hinge, nodes: [rod, slider], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}
)yaml" + drives;
}

}  // namespace

TEST_CASE("a driven rigid slider-crank follows the closed form to rounding") {
  const ReadyModel model(slider_crank("drives: {motor: {joint: main, angle: \"150*t\"}}\n"));
  double worst = 0;
  integrate(model, Scheme::generalized_alpha(0.8), 1e-4, 0.05, [&](const State& state) {
    const double a = 150 * state.time, r = 0.15, l = 0.3;
    const double x = r * std::cos(a) + std::sqrt(l * l - r * r * std::sin(a) * std::sin(a));
    worst = std::max(worst, std::abs(model.node(state, "slider").x.x() - x));
  });
  // Positions are algebraic here, so that their error is that of Newton's tolerance and rounding.
  CHECK(worst < 1e-10);
}

TEST_CASE("the drive's torque of a rigid slider-crank at constant speed is the inverse dynamics' one") {
  const ReadyModel model(slider_crank("drives: {motor: {joint: main, angle: \"150*t\"}}\n"));
  const double h = 30 * M_PI / 180 / 150 / 200;  // 200 steps to 30 degrees
  double torque_30 = 0, torque_90 = 0;
  integrate(model, Scheme::generalized_alpha(0.8), h, 600 * h, [&](const State& state) {
    const long step = std::lround(state.time / h);
    if (step == 200) torque_30 = -state.multiplier.tail<1>()[0];
    if (step == 600) torque_90 = -state.multiplier.tail<1>()[0];
  });
  const bielle::test::ReferenceTable exact("slider_crank");
  // The error is of second order in h: with 2400 steps per turn it is about 1e-5 of the torque.
  CHECK(torque_30 == Approx(exact("torque_30")).epsilon(1e-4));
  CHECK(torque_90 == Approx(exact("torque_90")).epsilon(1e-4));
}

TEST_CASE("a free rigid slider-crank keeps its phase: second order against the reduced equation of motion") {
  const ReadyModel model(slider_crank(""));
  const double exact = bielle::test::ReferenceTable("slider_crank")("free.slider");
  const auto error = [&](double h) {
    const State state = integrate(model, Scheme::generalized_alpha(0.9), h, 0.1);
    return model.node(state, "slider").x.x() - exact;
  };
  const double coarse = error(2e-4), fine = error(1e-4), finest = error(5e-5);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.1));
  CHECK(std::log2(fine / finest) == Approx(2).margin(0.1));
  // The remainder after Richardson's extrapolation is of higher order: the result agrees with the reference.
  CHECK(std::abs((4 * finest - fine) / 3) < 0.02 * std::abs(finest));
}

TEST_CASE("a slider-crank swinging under gravity and a torque converges with order 2") {
  // The same linkage released at 45 degrees; the crank's centre of mass halfway along it, gravity 9.81 m/s^2 along -y
  // and 0.05 N m on the crank. Its inertia is given about the pivot, where its node stands.
  const double a = M_PI / 4, b = std::asin(0.15 * std::sin(a) / 0.3);
  const Vector3 pin(0.15 * std::cos(a), 0.15 * std::sin(a), 0), wrist(pin.x() + 0.3 * std::cos(b), 0, 0);
  const auto list = [](const Vector3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); };
  const std::string text = fmt::format(R"yaml(
gravity: [0, -9.81, 0]
nodes:
  crank: {{position: [0, 0, 0], rotation_vector: [0, 0, "pi/4"]}}
  pin: {{position: {pin}}}
  rod: {{position: {rod}, rotation_vector: [0, 0, {tilt:.17g}]}}
  slider: {{position: {wrist}}}
elements:
  crank: {{type: rigid_body, node: crank, mass: 0.36, centre: [0.075, 0, 0], inertia: [0.0004, 0.002427, 0.002727], inertia_about: node, also: [pin]}}
  rod: {{type: rigid_body, node: rod, mass: 0.151104, inertia: [1e-6, 0.00113328, 0.00113328]}}
  slider: {{type: point_mass, node: slider, mass: 0.075552}}
joints:
  main: {{type: hinge, nodes: [ground, crank], axis: [0, 0, 1]}}
  big_end: {{type: hinge, nodes: [pin, rod], axis: [0, 0, 1], position: {pin}}}
  wrist: {{type: hinge, nodes: [rod, slider], axis: [0, 0, 1]}}
  guide: {{type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}}
drives: {{motor: {{joint: main, torque: 0.05}}}}
)yaml",
                                       fmt::arg("pin", list(pin)), fmt::arg("rod", list(0.5 * (pin + wrist))),
                                       fmt::arg("tilt", -b), fmt::arg("wrist", list(wrist)));
  const ReadyModel model(text);
  const bielle::test::ReferenceTable exact("slider_crank");
  const auto error = [&](double h) -> VectorX {
    VectorX e = VectorX::Zero(5);
    int row = 0;
    integrate(model, Scheme::generalized_alpha(0.9), h, 2, [&](const State& state) {
      const NodeState& crank = model.node(state, "crank");
      const double angle = std::atan2(crank.R(1, 0), crank.R(0, 0));
      if (std::abs(state.time - 1) < h / 2) {
        e.head<2>() << angle - exact("swinging.angle_1"), (crank.Omega.z() - exact("swinging.rate_1")) / 10;
        ++row;
      } else if (std::abs(state.time - 2) < h / 2) {
        e.tail<3>() << angle - exact("swinging.angle_2"), (crank.Omega.z() - exact("swinging.rate_2")) / 10,
            model.node(state, "slider").x.x() - exact("swinging.slider_2");
        ++row;
      }
    });
    CHECK(row == 2);
    return e;
  };
  bielle::test::check_second_order(error, 4e-3, 3);
}

}  // namespace test_rigid
