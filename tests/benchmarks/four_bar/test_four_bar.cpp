// Four-bar linkages of thin bars. (a) Ground 1.0, crank 0.3, coupler 0.9, rocker 0.7 m, 1 kg/m, gravity 9.81 m/s^2,
// crank released from 60 degrees: reduced equation of motion, DOP853, tolerances agree to 1e-10. (b) The N-loop
// four-bar of the IFToMM benchmark library (case A02): N + 1 vertical cranks and N couplers of 1 m and 1 kg; the
// reduced equation I thddot = G sin th, I = (N+1)/3 + N, G = g ((N+1)/2 + N), th from the upward vertical, th(0) = 0,
// thdot(0) = 1, DOP853 with rtol 1e-13. Whenever the bars lie in one line the linkage may branch; the motion goes on as
// a parallelogram.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// A thin bar from one point to another, about z.
std::string bar_node(const std::string& name, const Vector3& from, const Vector3& to, const std::string& rates = "") {
  const Vector3 centre = 0.5 * (from + to), along = to - from;
  return fmt::format("  {}: {{position: [{:.17g}, {:.17g}, 0], rotation_vector: [0, 0, {:.17g}]{}}}\n", name,
                     centre.x(), centre.y(), std::atan2(along.y(), along.x()), rates);
}

std::string bar_body(const std::string& name, double length) {
  // 1 kg/m; about its own axis the bar has almost nothing.
  const double J = length * length * length / 12;
  return fmt::format("  {}: {{type: rigid_body, node: {}, mass: {:.17g}, inertia: [{:.17g}, {:.17g}, {:.17g}]}}\n",
                     name, name, length, 1e-3 * J, J, J);
}

std::string hinge(const std::string& name, const std::string& first, const std::string& second, const Vector3& at) {
  return fmt::format("  {}: {{type: hinge, nodes: [{}, {}], axis: [0, 0, 1], position: [{:.17g}, {:.17g}, 0]}}\n", name,
                     first, second, at.x(), at.y());
}

/// Ends of coupler and rocker from the angle of the crank: the open branch.
std::string released_linkage() {
  const double a = M_PI / 3;
  const Vector3 A(0, 0, 0), D(1, 0, 0), B(0.3 * std::cos(a), 0.3 * std::sin(a), 0);
  const Vector3 BD = D - B;
  const double distance = BD.norm(), along = (0.81 - 0.49 + distance * distance) / (2 * distance);
  const Vector3 e = BD / distance, n(-e.y(), e.x(), 0);
  const Vector3 C = B + along * e + std::sqrt(0.81 - along * along) * n;
  return "gravity: [0, -9.81, 0]\nnodes:\n" + bar_node("crank", A, B) + bar_node("coupler", B, C) +
         bar_node("rocker", D, C) + "elements:\n" + bar_body("crank", 0.3) + bar_body("coupler", 0.9) +
         bar_body("rocker", 0.7) + "joints:\n" + hinge("a", "ground", "crank", A) + hinge("b", "crank", "coupler", B) +
         hinge("c", "coupler", "rocker", C) + hinge("d", "ground", "rocker", D);
}

/// N loops; at the start the cranks turn with 1 rad/s clockwise, so that the couplers move along +x.
std::string loops(int n) {
  std::string nodes = "nodes:\n", bodies = "elements:\n", joints = "joints:\n";
  for (int k = 0; k <= n; ++k) {
    const Vector3 foot(k, 0, 0), top(k, 1, 0);
    const std::string crank = fmt::format("crank{}", k);
    nodes += bar_node(crank, foot, top, ", velocity: [0.5, 0, 0], angular_velocity: [0, 0, -1]");
    bodies += bar_body(crank, 1);
    joints += hinge(fmt::format("foot{}", k), "ground", crank, foot);
    if (k == 0) continue;
    const std::string coupler = fmt::format("coupler{}", k);
    nodes += bar_node(coupler, Vector3(k - 1, 1, 0), top, ", velocity: [1, 0, 0]");
    bodies += bar_body(coupler, 1);
    joints += hinge(fmt::format("left{}", k), fmt::format("crank{}", k - 1), coupler, Vector3(k - 1, 1, 0));
    joints += hinge(fmt::format("right{}", k), coupler, crank, top);
  }
  return "gravity: [0, -9.81, 0]\n" + nodes + bodies + joints;
}

double kinetic_and_potential(const ReadyModel& model, const State& state) {
  const Energy e = model.system.energy(state, model.environment());
  return e.kinetic + e.gravity;
}

}  // namespace

TEST_CASE("a released four-bar converges with order 2 to its reduced equation of motion") {
  const ReadyModel model(released_linkage());
  const auto error = [&](double h) -> VectorX {
    const State state = integrate(model, Scheme::generalized_alpha(0.9), h, 1);
    const NodeState &crank = model.node(state, "crank"), &rocker = model.node(state, "rocker");
    const double angle = -4.56158469898;
    VectorX e(4);
    e << (rocker.x + rocker.R * Vector3(0.35, 0, 0) - Vector3(0.77676745318, 0.66345100048, 0)).head<2>(),
        crank.R.col(0).head<2>() - Eigen::Vector2d(std::cos(angle), std::sin(angle));
    return e;
  };
  check_second_order(error, 2e-3, 3, 0.2, 0.2);
}

TEST_CASE("loops of four-bars pass the positions with all bars in one line, and stay parallelograms") {
  struct Reference {
    int n;
    Eigen::Vector2d top_at_10;
    double energy;
  };
  for (const auto& [n, top_at_10, energy] : {Reference{1, {0.478385057756, 0.878150178794}, 20.4533},
                                             Reference{2, {0.328458111536, 0.944518538180}, 35.835}}) {
    CAPTURE(n);
    const ReadyModel model(loops(n));
    const double h = 1e-3;
    double skew_of_loops = 0, drift = 0;
    const State end = integrate(model, Scheme::generalized_alpha(0.9), h, 10, [&](const State& state) {
      for (int k = 1; k <= n; ++k) {
        const Vector3 lean =
            model.node(state, fmt::format("crank{}", k)).R.col(0) - model.node(state, "crank0").R.col(0);
        skew_of_loops = std::max(skew_of_loops, lean.norm());
      }
      drift = std::max(drift, std::abs(kinetic_and_potential(model, state) - energy));
    });
    CHECK(skew_of_loops < 1e-6);
    CHECK(drift < 1e-3 * energy);
    const NodeState& crank = model.node(end, "crank0");
    const Vector3 top = crank.x + 0.5 * crank.R.col(0);
    // Five turns with an error of the period of order (omega h)^2/12, omega up to 7 rad/s.
    CHECK((top.head<2>() - top_at_10).norm() < 5e-3);
  }
}
