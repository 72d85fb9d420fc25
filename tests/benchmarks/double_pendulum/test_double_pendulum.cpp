// The double pendulum: two masses of 1 kg on massless rods of 1 m, both horizontal at the start, at rest, gravity 9.81
// m/s^2. Reference: the two equations of motion in the angles from the vertical (tests/references/double_pendulum.py).
#include <catch2/catch.hpp>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace test_double_pendulum {
namespace {

const char* const pendulum = R"yaml(
gravity: [0, -9.81, 0]
nodes:
  upper: {position: [1, 0, 0]}
  lower: {position: [2, 0, 0]}
elements:
  upper: {type: rigid_body, node: upper, mass: 1, inertia: [1e-12, 1e-12, 1e-12]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [1e-12, 1e-12, 1e-12]}
joints:
  pivot: {type: hinge, nodes: [ground, upper], axis: [0, 0, 1], position: [0, 0, 0]}
  knee: {type: hinge, nodes: [upper, lower], axis: [0, 0, 1], position: [1, 0, 0]}
)yaml";

/// Returns the positions of the two masses, from the angles of the rods.
VectorX masses(double upper, double lower) {
  VectorX x(6);
  x << std::sin(upper), -std::cos(upper), 0, std::sin(upper) + std::sin(lower), -std::cos(upper) - std::cos(lower), 0;
  return x;
}

}  // namespace

TEST_CASE("the double pendulum converges with order 2") {
  const ReadyModel model(pendulum);
  const auto error = [&](double h, double end, const VectorX& exact) -> VectorX {
    const State state = integrate(model, Scheme::generalized_alpha(0.9), h, end);
    VectorX x(6);
    x << model.node(state, "upper").x, model.node(state, "lower").x;
    return x - exact;
  };
  const bielle::test::ReferenceTable exact("double_pendulum");
  const VectorX at_1 = masses(exact("upper_at_1"), exact("lower_at_1")),
                at_2 = masses(exact("upper_at_2"), exact("lower_at_2"));
  check_second_order([&](double h) { return error(h, 1, at_1); }, 4e-3, 3);
  check_second_order([&](double h) { return error(h, 2, at_2); }, 2e-3, 2, 0.2, 0.2);
}

}  // namespace test_double_pendulum
