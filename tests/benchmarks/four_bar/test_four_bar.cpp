// Four-bar linkages of thin bars: one released under gravity, and loops of them (loops.hpp). The first: ground 1.0,
// crank 0.3, coupler 0.9, rocker 0.7 m, 1 kg/m, gravity 9.81 m/s^2, crank released from 60 degrees; equations of motion
// in Cartesian coordinates (tests/references/four_bar.py).
#include <catch2/catch.hpp>

#include "tests/benchmarks/four_bar/loops.hpp"
#include "tests/support/four_bar.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using namespace bielle::four_bar;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

std::string released_linkage() {
  const auto [A, B, C, D] = bielle::test::released_four_bar();
  return "gravity: [0, -9.81, 0]\nnodes:\n" + bar_node("crank", A, B) + bar_node("coupler", B, C) +
         bar_node("rocker", D, C) + "elements:\n" + bar_body("crank", 0.3) + bar_body("coupler", 0.9) +
         bar_body("rocker", 0.7) + "joints:\n" + hinge("a", "ground", "crank", A) + hinge("b", "crank", "coupler", B) +
         hinge("c", "coupler", "rocker", C) + hinge("d", "ground", "rocker", D);
}

}  // namespace

TEST_CASE("a released four-bar converges with order 2 to its reduced equation of motion") {
  const ReadyModel model(released_linkage());
  const bielle::test::ReferenceTable exact("four_bar");
  const auto error = [&](double h) -> VectorX {
    const State state = integrate(model, Scheme::generalized_alpha(0.9), h, 1);
    const NodeState &crank = model.node(state, "crank"), &rocker = model.node(state, "rocker");
    const double angle = exact("released.crank");
    VectorX e(4);
    e << (rocker.x + rocker.R * Vector3(0.35, 0, 0)).head<2>() - exact.plane("released.tip"),
        crank.R.col(0).head<2>() - Eigen::Vector2d(std::cos(angle), std::sin(angle));
    return e;
  };
  check_second_order(error, 2e-3, 3, 0.2, 0.2);
}

TEST_CASE("loops of four-bars pass the positions with all bars in one line, and stay parallelograms") {
  check_loops(1);
  check_loops(2);
}
