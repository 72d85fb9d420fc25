// Growing motions that are not listed are counted.
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

/// Returns rods of different lengths, each on a hinge of its own: `standing` of them stand, the others hang.
std::string rods(int count, int standing, double damping = 0) {
  std::string nodes, elements, joints;
  for (int k = 0; k < count; ++k) {
    const double l = 0.1 * (k + 1), z = (k < standing ? 0.5 : -0.5) * l;
    nodes += fmt::format("  r{}: {{position: [{}, 0, {}]}}\n", k, k, z);
    elements +=
        fmt::format("  r{0}: {{type: rigid_body, node: r{0}, mass: 1, inertia: [{1}, {1}, {1}]}}\n", k, l * l / 12);
    joints += fmt::format(
        "  j{0}: {{type: hinge, nodes: [ground, r{0}], position: [{0}, 0, 0], axis: [0, 1, 0], damping: {1}}}\n", k,
        damping);
  }
  return "gravity: [0, 0, -9.81]\nnodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints;
}

long listed(const ModesReport& report) {
  return std::count_if(report.found.modes.begin(), report.found.modes.end(),
                       [](const Mode& mode) { return mode.kind == ModeKind::growing; });
}

}  // namespace

TEST_CASE("standing rods grow one by one, listed or not", "[linearised]") {
  // s = sqrt(3 g/2 l): shorter pendulums grow faster.
  for (const double damping : {0.0, 0.05})
    for (const int standing : {0, 1, 7, 12}) {
      const ModesOf model(rods(12, standing, damping));
      for (const int count : {1, 4, 100}) {
        CAPTURE(damping, standing, count);
        const ModesReport report = model({.count = count});
        REQUIRE(report.found.growing_besides);
        CHECK(listed(report) + *report.found.growing_besides == standing);
      }
      const ModesReport below = model({.below = 1.2});  // the slowest of them, 0.56 Hz to 1.9 Hz
      CHECK(listed(below) + below.found.growing_besides.value_or(-1) == standing);
      const ModesReport near = model({.count = 2, .near = 1.0});
      CHECK(listed(near) + near.found.growing_besides.value_or(-1) == standing);
    }
}

TEST_CASE("of equal growing motions those that are not listed are counted", "[linearised]") {
  const ModesReport report = ModesOf(
      "gravity: [0, 0, -9.81]\nnodes: {a: {position: [0, 0, 1]}, b: {position: [0, 0, 1]}}\n"
      "elements:\n  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
      "  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
      "joints:\n  a: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0]}\n"
      "  b: {type: hinge, nodes: [ground, b], position: [0, 0, 0], axis: [0, 1, 0]}\n")({.count = 1});
  CHECK(listed(report) == 1);
  CHECK(report.found.growing_besides == 1);
}

TEST_CASE("of equations that are not symmetric growing motions are not counted", "[linearised]") {
  const ModesReport spinning = ModesOf(
      "nodes: {b: {position: [0, 0, 0], fixed: [x, y, z], angular_velocity: [0, 4, 0]}}\n"
      "elements: {b: {type: rigid_body, node: b, mass: 1, inertia: [1, 2, 2.5]}}\n")({.count = 1});
  if (!spinning.found.all) CHECK_FALSE(spinning.found.growing_besides);
}
