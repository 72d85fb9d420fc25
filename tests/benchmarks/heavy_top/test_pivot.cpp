// The heavy top of O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121: force of its pivot, energy of its
// start, and its steady precession with a level axis. Data and reference as in test_heavy_top.cpp.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

TEST_CASE("the heavy top: the force of its pivot converges to that of the Euler-Poinsot equations") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {top: {position: [0, 1, 0], velocity: [4.61538, 0, 0], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}
joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}
)yaml");
  const bielle::test::ReferenceTable exact("heavy_top");
  const auto errors = [&](double h) -> VectorX {
    VectorX e = VectorX::Zero(6);
    integrate(model, Scheme::generalized_alpha(0.8), h, 2, [&](const State& state) {
      // The force on the body in inertial axes is m (a - g).
      const auto force = [&] { return Vector3(15 * (model.node(state, "top").a + Vector3(0, 0, 9.81))); };
      if (std::abs(state.time - 1) < h / 2) e.head<3>() = force() - exact.vector("1.force");
      if (std::abs(state.time - 2) < h / 2) e.tail<3>() = force() - exact.vector("2.force");
    });
    return e;
  };
  check_second_order(errors, 5e-4, 2, 0.1, 0.1);
}

TEST_CASE("the heavy top starts with the energy that belongs to its data") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {tip: {fixed: [x, y, z], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: tip, mass: 15, centre: [0, 1, 0], inertia: [0.234375, 0.46875, 0.234375]}}
)yaml");
  const Energy energy = model.system.energy(model.system.start(0), model.environment());
  CHECK(energy.kinetic + energy.gravity == Approx(bielle::test::ReferenceTable("heavy_top")("energy")).epsilon(1e-14));
}

TEST_CASE("the heavy top with a level axis precesses steadily at m g l/(C w_3) = 2.0928 rad/s") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {tip: {fixed: [x, y, z], angular_velocity: [0, 150, 2.0928]}}
elements: {top: {type: rigid_body, node: tip, mass: 15, centre: [0, 1, 0], inertia: [0.234375, 0.46875, 0.234375]}}
)yaml");
  const auto errors = [&](double h) -> VectorX {
    const State state = integrate(model, Scheme::generalized_alpha(0.9), h, 0.5);
    return model.node(state, "tip").R.col(1) - Vector3(-std::sin(0.5 * 2.0928), std::cos(0.5 * 2.0928), 0);
  };
  check_second_order(errors, 1e-3, 2, 0.1, 0.1);
}
