// The simple pendulum of the IFToMM benchmark library (case A01): 1 kg on a massless rod of 1 m, hinge at the origin,
// gravity 9.81 m/s^2 along -y, released at rest from (-1, 0). Closed form with Jacobi's elliptic functions
// (tests/references/simple_pendulum.py).
#include <catch2/catch.hpp>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// Returns a point mass that a hinge on a massless frame holds. If `direct`, the body's node is at the mass, else at
/// the pivot.
std::string pendulum(bool direct) {
  const std::string head = "gravity: [0, -9.81, 0]\n";
  // The rod has no inertia about the mass. A body with almost no inertia rotates about z nevertheless.
  const std::string inertia = "inertia: [1e-12, 1e-12, 1e-12]";
  return head +
         (direct ? "nodes: {bob: {position: [-1, 0, 0]}}\n"
                   "elements: {bob: {type: rigid_body, node: bob, mass: 1, " +
                       inertia + "}}\n"
                 : "nodes: {bob: {position: [0, 0, 0]}}\n"
                   "elements: {bob: {type: rigid_body, node: bob, mass: 1, centre: [-1, 0, 0], " +
                       inertia + "}}\n") +
         "joints: {pivot: {type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0]}}\n";
}

const Scheme scheme = Scheme::generalized_alpha(0.9);

}  // namespace

TEST_CASE("the simple pendulum converges with order 2 to its closed form, from whichever node it is described") {
  const bielle::test::ReferenceTable table("simple_pendulum");
  Vector3 at_1 = Vector3::Zero(), at_5 = Vector3::Zero();
  at_1.head<2>() = table.plane("1");
  at_5.head<2>() = table.plane("5");
  for (const bool direct : {true, false}) {
    const ReadyModel model(pendulum(direct));
    const auto place = [&](double h, double t) -> Vector3 {
      const NodeState bob = model.node(integrate(model, scheme, h, t), "bob");
      return direct ? bob.x : Vector3(bob.x + bob.R * Vector3(-1, 0, 0));
    };
    check_second_order([&](double h) -> VectorX { return place(h, 1) - at_1; }, 1e-2, 4);
    check_second_order([&](double h) -> VectorX { return place(h, 5) - at_5; }, 4e-3, 2);
  }
}

TEST_CASE("the tension of the simple pendulum's rod converges with order 2") {
  const ReadyModel model(pendulum(true));
  const double exact = bielle::test::ReferenceTable("simple_pendulum")("tension_10");
  const auto error = [&](double h) -> VectorX {
    const State state = integrate(model, scheme, h, 10);
    // The hinge's force on the mass, towards the pivot.
    return VectorX::Constant(1, state.multiplier.head<3>().norm() - exact);
  };
  check_second_order(error, 2e-3, 2, 0.2, 0.2);
}

TEST_CASE("the simple pendulum is fastest and pulls most at the bottom") {
  const ReadyModel model(pendulum(true));
  double speed = 0, tension = 0;
  integrate(model, scheme, 1e-3, 2.5, [&](const State& state) {
    speed = std::max(speed, model.node(state, "bob").v.norm());
    if (state.time > 0.1) tension = std::max(tension, state.multiplier.head<3>().norm());
  });
  // The force is v^2 = 2 g l, 3 m g; with steps of 1e-3 s a row is at most 5e-4 s away from the bottom: (4.4 *
  // 5e-4)^2/2 relative.
  CHECK(speed == Approx(4.42944691807002).epsilon(1e-5));
  CHECK(tension == Approx(29.43).epsilon(2e-5));
}
