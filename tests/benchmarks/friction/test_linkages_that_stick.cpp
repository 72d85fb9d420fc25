// Loops and chains whose hinges all stick and slip run to the end for any lengths, masses, coefficients and radii. They
// contain dead centres of each joint, reversals at which all joints come to rest at once, and rest. The energy balance
// is closed.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/four_bar/loops.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::Random;

namespace {

/// Returns a four-bar of any lengths that close, in the plane x-y.
std::string linkage(Random& random) {
  using namespace bielle::four_bar;
  std::array<double, 4> l{};
  Vector3 A = Vector3::Zero(), B, C, D;
  for (;;) {
    for (double& each : l) each = random.uniform(0.2, 1);
    const double th = random.uniform(0, 2 * M_PI);
    D = Vector3(l[3], 0, 0);
    B = l[0] * Vector3(std::cos(th), std::sin(th), 0);
    const double far = (D - B).norm();
    if (far >= l[1] + l[2] - 0.05 || far <= std::abs(l[1] - l[2]) + 0.05) continue;
    const double along = (l[1] * l[1] - l[2] * l[2] + far * far) / (2 * far);
    const Vector3 e = (D - B) / far, n(-e.y(), e.x(), 0);
    C = B + along * e + (random.uniform(-1, 1) < 0 ? -1 : 1) * std::sqrt(l[1] * l[1] - along * along) * n;
    break;
  }
  const double mu = random.uniform(0.05, 0.6);
  const std::string at_rest =
      random.uniform(-1, 1) < 0 ? "" : fmt::format(", static: {:.17g}, stribeck_velocity: 0.01", 1.3 * mu);
  const std::string rate =
      random.uniform(-1, 1) < 0 ? "" : fmt::format(", start_rate: {:.17g}", random.uniform(-10, 10));
  const auto rubbing = [&](std::string text, const std::string& more = "") {
    text.insert(text.rfind('}'),
                fmt::format("{}, friction: {{model: stick_slip, coefficient: {:.17g}{}, radius: {:.17g}}}", more, mu,
                            at_rest, random.uniform(0.005, 0.05)));
    return text;
  };
  std::string joints = rubbing(hinge("a", "ground", "crank", A), rate);
  joints += rubbing(hinge("b", "crank", "coupler", B));
  joints += rubbing(hinge("c", "coupler", "rocker", C));
  joints += rubbing(hinge("d", "ground", "rocker", D));
  return "gravity: [0, -9.81, 0]\nnodes:\n" + bar_node("crank", A, B) + bar_node("coupler", B, C) +
         bar_node("rocker", D, C) + "elements:\n" + bar_body("crank", l[0]) + bar_body("coupler", l[1]) +
         bar_body("rocker", l[2]) + "joints:\n" + joints;
}

/// Returns a chain of links of 1 m, horizontal from the ground.
std::string chain(int links) {
  std::string nodes = "nodes:\n", elements = "elements:\n", joints = "joints:\n";
  for (int k = 0; k < links; ++k) {
    nodes += fmt::format("  n{}: {{position: [{}, 0, 0]}}\n", k, k + 0.5);
    elements += fmt::format("  e{0}: {{type: rigid_body, node: n{0}, mass: 1, inertia: [1e-3, 1/12, 1/12]}}\n", k);
    joints += fmt::format(
        "  j{}: {{type: hinge, axis: [0, 1, 0], nodes: [{}, n{}], position: [{}, 0, 0], friction: {{model: "
        "stick_slip, coefficient: 0.1, radius: 0.02}}}}\n",
        k, k == 0 ? "ground" : fmt::format("n{}", k - 1), k, k);
  }
  return "gravity: [0, 0, -9.81]\n" + nodes + elements + joints;
}

/// Returns the gap in the energy over the largest energy, and the number of events.
std::pair<double, long> run(const std::string& text, double h, double end) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = end;
  options.stepping.size = h;
  Motion motion = session.dynamics(options);
  double worst = 0;
  while (motion.step()) worst = std::max(worst, std::abs(motion.balance()));
  return {worst, motion.log().crossings};
}

}  // namespace

TEST_CASE("four-bars of all kinds whose hinges stick and slip run through") {
  Random random(15);
  long events = 0;
  for (int k = 0; k < 55; ++k) {
    const std::string text = linkage(random);
    const auto [coarse, few] = run(text, 1e-3, 2);
    const auto [fine, met] = run(text, 5e-4, 2);
    CAPTURE(k, text, coarse, fine);
    // The gap of the balance is the scheme's error, which is of second order in each linkage: no impulse removes
    // energy.
    CHECK(fine < std::max(5e-3, 0.4 * coarse));
    events += met;
  }
  CHECK(events > 500);
}

TEST_CASE("a chain of forty hinges that stick lets go from rest") {
  const auto [gap, events] = run(chain(40), 1e-3, 5e-3);
  CHECK(gap < 1e-4);
  CHECK(events > 20);
}
