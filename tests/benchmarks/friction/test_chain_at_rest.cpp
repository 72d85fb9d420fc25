// A chain of hinges with bristles (LuGre) that hangs off the vertical: friction holds it for a thousand seconds. The
// bristles yield once, then nothing creeps. With f_j the share of mu N_j r that the weight below hinge j requires, a
// bristle goes from 0 to f mu/sigma_0 over a distance of -(mu/sigma_0) ln(1 - f) if the motion does not reverse, and
// over a few times as much if the links rock as friction begins.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;

namespace test_chain_at_rest {
namespace {

constexpr int links = 8;
constexpr double mu = 0.4, radius = 0.1, sigma_0 = 2e4, length = 0.5, lean = 0.06;  // [rad], each the other way

double weight_below(int joint) { return 9.81 * (links - joint); }

/// Returns the lean of a link from the vertical.
double angle(int link) { return link % 2 == 0 ? lean : -lean; }

std::string chain() {
  std::string nodes = "nodes:\n", elements = "elements:\n", joints = "joints:\n";
  double x = 0, z = 0;
  for (int k = 0; k < links; ++k) {
    const double s = std::sin(angle(k)), c = std::cos(angle(k));
    nodes += fmt::format("  n{}: {{position: [{:.17g}, 0, {:.17g}], rotation_vector: [0, {:.17g}, 0]}}\n", k,
                         x + 0.5 * length * s, z - 0.5 * length * c, -angle(k));
    elements += fmt::format("  e{0}: {{type: rigid_body, node: n{0}, mass: 1, inertia: [0.02, 0.02, 1e-3]}}\n", k);
    joints += fmt::format(
        "  j{}: {{type: hinge, nodes: [{}, n{}], position: [{:.17g}, 0, {:.17g}], axis: [0, 1, 0], friction: {{model: "
        "lugre, coefficient: {}, bristle_stiffness: {}, bristle_damping: 200, radius: {}}}}}\n",
        k, k == 0 ? "ground" : fmt::format("n{}", k - 1), k, x, z, mu, sigma_0, radius);
    x += length * s;
    z -= length * c;
  }
  return "gravity: [0, 0, -9.81]\n" + nodes + elements + joints;
}

/// Returns the share of the friction capacity of a hinge that the weight below it requires.
double share(int joint) {
  double moment = 0, arm = 0;
  for (int k = joint; k < links; ++k) {
    moment += 9.81 * (arm + 0.5 * length * std::sin(angle(k)));
    arm += length * std::sin(angle(k));
  }
  return std::abs(moment) / (mu * radius * weight_below(joint));
}

}  // namespace

TEST_CASE("a chain of hinges with bristles hangs still for 1000 s") {
  std::array<double, links> settled{}, end{};
  bielle::test::move(chain(), 0.02, 1000, [&](const Session& session) {
    for (int k = 0; k < links; ++k)
      end[static_cast<std::size_t>(k)] = session.read(fmt::format("joints/j{}/coordinate", k))[0];
    if (session.time() <= 100) settled = end;
  });
  for (int k = 0; k < links; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double f = share(k), yields = -mu / sigma_0 * std::log(1 - f);
    CAPTURE(k, f, settled[at], end[at]);
    CHECK(f < 0.5);
    CHECK(radius * std::abs(settled[at]) < 3 * yields);
    CHECK(std::abs(end[at] - settled[at]) < 1e-9);
  }
  CHECK(share(0) > 0.2);
}

}  // namespace test_chain_at_rest
