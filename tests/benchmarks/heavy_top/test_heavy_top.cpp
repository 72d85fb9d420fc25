// The heavy top of O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121 over two seconds, described two
// ways: node at the centre of mass and joint at the tip, or node at the tip, which is held. m = 15 kg, J =
// diag(0.234375, 0.46875, 0.234375) kg m^2 about the centre at (0, 1, 0), Omega(0) = (0, 150, -4.61538) rad/s.
// Reference: Euler-Poinsot equations in quaternions, DOP853 with rtol 1e-13 (drift of the energy below 2e-10 of 5436
// J). Orders of convergence: tests/order.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

const std::string centre = R"yaml(
gravity: [0, 0, -9.81]
nodes: {top: {position: [0, 1, 0], velocity: [4.61538, 0, 0], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}
joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}
)yaml";

// The tip held as a node: no constraint, no multiplier. Inertia about the node: 0.234375 + 15 = 15.234375.
const std::string tip = R"yaml(
gravity: [0, 0, -9.81]
nodes: {tip: {fixed: [x, y, z], angular_velocity: [0, 150, -4.61538]}}
elements:
  top: {type: rigid_body, node: tip, mass: 15, centre: [0, 1, 0], inertia: [15.234375, 0.46875, 15.234375], inertia_about: node}
)yaml";

struct Row {
  double time;
  Vector3 x, Omega;
};

const Row rows[] = {
    {0.1, {0.42129665893, 0.89457197435, -0.14916470056}, {4.808941332, 150, 1.028300757}},
    {0.5, {-0.70246829706, -0.02116518470, -0.71140025765}, {-0.471053102, 150, 5.901083048}},
    {1, {0.17334396410, 0.64008859207, -0.74849079113}, {-0.822078102, 150, -5.923291348}},
    {1.5, {-0.96816571564, 0.25030606213, -0.00142208385}, {0.346213784, 150, 4.605359985}},
    {2, {-0.15041682275, -0.72416559164, -0.67302226956}, {0.122233219, 150, -5.855624589}},
};

}  // namespace

TEST_CASE("the heavy top follows the Euler-Poinsot equations for two seconds, however it is described") {
  for (const std::string& text : {centre, tip}) {
    const ReadyModel model(text);
    const bool from_tip = text == tip;
    const auto errors = [&](double h) -> VectorX {
      VectorX e = VectorX::Zero(6 * 5);
      int k = 0;
      integrate(model, Scheme::generalized_alpha(0.9), h, 2, [&](const State& state) {
        if (k == 5 || std::abs(state.time - rows[k].time) > h / 2) return;
        const NodeState& node = model.node(state, from_tip ? "tip" : "top");
        const Vector3 x = from_tip ? Vector3(node.x + node.R * Vector3(0, 1, 0)) : node.x;
        e.segment<6>(6 * k) << x - rows[k].x, (node.Omega - rows[k].Omega) / 5;
        ++k;
      });
      CHECK(k == 5);
      return e;
    };
    check_second_order(errors, 1e-3, 2, 0.1, 0.1);
  }
}

TEST_CASE("the heavy top: the force of its pivot converges to that of the Euler-Poinsot equations") {
  // On the body, inertial; the multipliers of a spherical joint at the tip.
  const ReadyModel model(centre);
  const auto errors = [&](double h) -> VectorX {
    VectorX e = VectorX::Zero(6);
    integrate(model, Scheme::generalized_alpha(0.8), h, 2, [&](const State& state) {
      const auto force = [&] { return Vector3(15 * (model.node(state, "top").a + Vector3(0, 0, 9.81))); };
      if (std::abs(state.time - 1) < h / 2) e.head<3>() = force() - Vector3(-517.6007395, -396.8431015, 404.5749252);
      if (std::abs(state.time - 2) < h / 2) e.tail<3>() = force() - Vector3(-260.7352113, 613.6126990, 309.7166314);
    });
    return e;
  };
  check_second_order(errors, 1e-3, 2, 0.1, 0.1);
}

TEST_CASE("the heavy top starts with the energy that belongs to its data") {
  const ReadyModel model(tip);
  const Energy energy = model.system.energy(model.system.start(0), model.environment());
  CHECK(energy.kinetic + energy.gravity == Approx(5435.696790865547).epsilon(1e-14));
}

TEST_CASE("steady precession: a top that starts on a root of its equation keeps its inclination and its rate") {
  // A w_p^2 cos(th) - C w_3 w_p + m g l = 0 (at 90 degrees m g l/(C w_3)) with A = 15.234375 about the pivot, C =
  // 0.46875, w_3 = 150 rad/s.
  struct Case {
    double degrees, precession;
  };
  for (const Case& c : {Case{60, 3.206973701704}, {60, 6.023795529065}, {90, 2.0928}}) {
    const double th = c.degrees * M_PI / 180, spin = 150;
    // The axis leans towards y; the body turns with w_p about z and the rest about its axis. In its axes y is the
    // axis: w = w_p z + (w_3 - w_p cos th) axis.
    const Vector3 axis(0, std::sin(th), std::cos(th));
    const Vector3 omega = c.precession * Vector3::UnitZ() + (spin - c.precession * std::cos(th)) * axis;
    const Matrix3 R = Eigen::AngleAxisd(M_PI / 2 - th, Vector3::UnitX()).toRotationMatrix();
    const Vector3 Omega = R.transpose() * omega, v = omega.cross(axis);
    const auto list = [](const Vector3& a) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", a.x(), a.y(), a.z()); };
    const ReadyModel model(
        "gravity: [0, 0, -9.81]\nnodes: {top: {position: " + list(axis) + ", velocity: " + list(v) +
        ", angular_velocity: " + list(Omega) + fmt::format(", rotation_vector: [{:.17g}, 0, 0]", M_PI / 2 - th) +
        "}}\nelements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}\n"
        "joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}\n");
    const double end = 0.5;
    const auto errors = [&](double h) -> VectorX {
      const Vector3 x = model.node(integrate(model, Scheme::generalized_alpha(0.9), h, end), "top").x;
      return Eigen::Vector2d(x.z() - std::cos(th),
                             std::remainder(std::atan2(x.y(), x.x()) - M_PI / 2 - c.precession * end, 2 * M_PI));
    };
    check_second_order(errors, 1e-3, 2, 0.1, 0.1);
  }
}
