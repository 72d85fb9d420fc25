// A free body spun about its intermediate axis turns over and over (Dzhanibekov): J = diag(1, 2, 3) kg m^2, Omega(0) =
// (0.01, 5, 0.01) rad/s. Closed form by Jacobi's elliptic functions (L. D. Landau, E. M. Lifshitz, Mechanics, section
// 37), with 40 digits (tests/references/torque_free_body.py): it flips every 5.03 s, first when Omega_2 = 0 at 2.74 s.
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace test_torque_free_body {
namespace {

const char* const body = R"yaml(
nodes: {body: {angular_velocity: [0.01, 5, 0.01]}}
elements: {body: {type: rigid_body, node: body, mass: 1, inertia: [1, 2, 3]}}
)yaml";

const Scheme scheme = Scheme::generalized_alpha(0.9);

}  // namespace

TEST_CASE("a body turning about its intermediate axis follows the elliptic functions with order 2") {
  const ReadyModel model(body);
  const Vector3 exact =
      bielle::test::ReferenceTable("torque_free_body").vector("10.Omega");  // at 10 s, after two flips
  check_second_order(
      [&](double h) -> VectorX { return model.node(integrate(model, scheme, h, 10), "body").Omega - exact; }, 4e-3, 3,
      0.2, 0.2);
}

TEST_CASE("a body turning about its intermediate axis is right after four flips, too") {
  const ReadyModel model(body);
  const Vector3 exact = bielle::test::ReferenceTable("torque_free_body").vector("20.Omega");
  check_second_order(
      [&](double h) -> VectorX { return model.node(integrate(model, scheme, h, 20), "body").Omega - exact; }, 2e-3, 2,
      0.2, 0.2);
}

TEST_CASE("a body turning about its intermediate axis flips when the closed form does, with order 2") {
  const ReadyModel model(body);
  const bielle::test::ReferenceTable exact("torque_free_body");
  const auto flips = [&](double h) -> VectorX {
    std::vector<double> times;
    double before = 0, time = 0;
    integrate(model, scheme, h, 9, [&](const State& state) {
      const double Omega = model.node(state, "body").Omega.y();
      // Near a crossing Omega_2 is linear in time up to its third derivative.
      if (before * Omega < 0) times.push_back(time + (state.time - time) * before / (before - Omega));
      before = Omega;
      time = state.time;
    });
    REQUIRE(times.size() == 2);
    return Eigen::Vector2d(times[0] - exact("first_flip"), times[1] - times[0] - exact("between_flips"));
  };
  check_second_order(flips, 8e-3, 3, 0.2, 0.2);
}

TEST_CASE("the angular momentum of a free body keeps its direction and length in space with order 2") {
  const ReadyModel model(body);
  const auto drift = [&](double h) -> VectorX {
    const NodeState node = model.node(integrate(model, scheme, h, 10), "body");
    return node.R * Vector3(1, 2, 3).cwiseProduct(node.Omega) - Vector3(0.01, 10, 0.03);
  };
  check_second_order(drift, 8e-3, 3, 0.2, 0.2);
}

}  // namespace test_torque_free_body
