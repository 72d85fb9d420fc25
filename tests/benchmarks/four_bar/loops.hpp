// The N-loop four-bar of the IFToMM benchmark library (case A02): N + 1 vertical cranks and N couplers, thin bars of 1
// m and 1 kg. The reduced equation is I thddot = G sin th, I = (N+1)/3 + N, G = g ((N+1)/2 + N), th from the upward
// vertical, th(0) = 0, thdot(0) = 1 (tests/references/four_bar.py). Whenever the bars lie in one line the linkage may
// branch; the motion goes on as a parallelogram.
#pragma once

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"

namespace bielle::four_bar {

using mechanism::Vector3;

/// Returns a thin bar from one point to another, about z.
inline std::string bar_node(const std::string& name, const Vector3& from, const Vector3& to,
                            const std::string& rates = "") {
  const Vector3 centre = 0.5 * (from + to), along = to - from;
  return fmt::format("  {}: {{position: [{:.17g}, {:.17g}, 0], rotation_vector: [0, 0, {:.17g}]{}}}\n", name,
                     centre.x(), centre.y(), std::atan2(along.y(), along.x()), rates);
}

inline std::string bar_body(const std::string& name, double length) {
  // The bar has 1 kg/m, and a negligible moment of inertia about its own axis.
  const double J = length * length * length / 12;
  return fmt::format("  {}: {{type: rigid_body, node: {}, mass: {:.17g}, inertia: [{:.17g}, {:.17g}, {:.17g}]}}\n",
                     name, name, length, 1e-3 * J, J, J);
}

inline std::string hinge(const std::string& name, const std::string& first, const std::string& second,
                         const Vector3& at) {
  return fmt::format("  {}: {{type: hinge, nodes: [{}, {}], axis: [0, 0, 1], position: [{:.17g}, {:.17g}, 0]}}\n", name,
                     first, second, at.x(), at.y());
}

/// There are N loops; at the start the cranks turn with 1 rad/s clockwise, so that the couplers move along +x.
inline std::string loops(int n) {
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

/// Ten seconds in steps of 1 ms against the reference: end of the first crank, and the energy.
inline void check_loops(int n) {
  CAPTURE(n);
  const Eigen::Vector2d top_at_10 = test::ReferenceTable("four_bar").plane(fmt::format("loops_{}.top", n));
  const double energy = 0.5 * ((n + 1) / 3.0 + n) + 9.81 * (0.5 * (n + 1) + n);
  const test::ReadyModel model(loops(n));
  const auto crank = [&](const mechanism::State& state, int k) -> const mechanism::NodeState& {
    return model.node(state, fmt::format("crank{}", k));
  };
  double skew_of_loops = 0, drift = 0;
  const mechanism::State end =
      test::integrate(model, mechanism::Scheme::generalized_alpha(0.9), 1e-3, 10, [&](const mechanism::State& state) {
        for (int k = 1; k <= n; ++k)
          skew_of_loops = std::max(skew_of_loops, (crank(state, k).R.col(0) - crank(state, 0).R.col(0)).norm());
        const mechanism::Energy e = model.system.energy(state, model.environment());
        drift = std::max(drift, std::abs(e.kinetic + e.gravity - energy));
      });
  CHECK(skew_of_loops < 1e-6);
  CHECK(drift < 1e-3 * energy);
  const Vector3 top = crank(end, 0).x + 0.5 * crank(end, 0).R.col(0);
  // The motion makes five turns with an error of the period of order (omega h)^2/12, omega up to 7 rad/s.
  CHECK((top.head<2>() - top_at_10).norm() < 5e-3);
}

}  // namespace bielle::four_bar
