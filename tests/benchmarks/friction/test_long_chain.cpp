// A hundred hinges with Coulomb's law: a hanging chain that swings until all of it sticks, with its energy balance, and
// the positions in which it may come to rest.
#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

namespace test_long_chain {
namespace {

constexpr int links = 100;
constexpr double length = 0.02, mass = 0.01, mu = 0.3, radius = 0.02, g = 9.81, omega = 0.05;

/// The chain hangs straight down and turns about the uppermost hinge at `omega`.
std::string chain() {
  std::string nodes = "nodes:\n", elements = "elements:\n", joints = "joints:\n";
  for (int k = 0; k < links; ++k) {
    const double z = -(k + 0.5) * length;
    nodes +=
        fmt::format("  n{}: {{position: [0, 0, {:.17g}], velocity: [{:.17g}, 0, 0], angular_velocity: [0, {}, 0]}}\n",
                    k, z, omega * z, omega);
    elements +=
        fmt::format("  e{0}: {{type: rigid_body, node: n{0}, mass: {1}, inertia: [1e-6, 1e-6, 1e-6]}}\n", k, mass);
    joints += fmt::format(
        "  j{}: {{type: hinge, nodes: [{}, n{}], position: [0, 0, {:.17g}], axis: [0, 1, 0], friction: {{model: "
        "stick_slip, coefficient: {}, radius: {}}}}}\n",
        k, k == 0 ? "ground" : fmt::format("n{}", k - 1), k, -k * length, mu, radius);
  }
  return "gravity: [0, 0, -9.81]\n" + nodes + elements + joints;
}

}  // namespace

TEST_CASE("a hanging chain of a hundred hinges that stick and slip comes to rest") {
  const MechanismFile file = read_mechanism_text(chain(), "chain.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = 4;
  options.stepping.size = 2e-3;
  Motion motion = session.dynamics(options);
  const double begun = motion.energy().kinetic;
  double worst = 0, dissipated = 0, taken_back = 0, rest = 0;
  while (motion.step()) {
    worst = std::max(worst, std::abs(motion.balance()));
    taken_back = std::max(taken_back, dissipated - motion.energy().dissipation);
    dissipated = motion.energy().dissipation;
    if (motion.energy().kinetic > 1e-20) rest = session.time();
  }
  INFO(motion.log().steps << " steps, " << motion.log().crossings << " events, at rest after " << rest << " s");
  CHECK(motion.log().crossings > 100);
  CHECK(rest < options.duration - 0.1);
  // An event that changes the algorithmic velocities by their correction must not count this change as a loss.
  CHECK(worst < 1e-5 * begun);
  CHECK(taken_back < 1e-5 * begun);
  // The parts below a hinge require no more friction than it can carry: mu times the weight below, on its radius.
  double x = 0;
  std::vector<double> at(links), joint(links);
  for (int k = 0; k < links; ++k) {
    CHECK(session.read(fmt::format("joints/j{}/sticks", k))[0] == 1);
    at[static_cast<std::size_t>(k)] = session.node(fmt::format("n{}", k)).x.x();
    joint[static_cast<std::size_t>(k)] = x;
    x = 2 * at[static_cast<std::size_t>(k)] - x;
  }
  for (int k = 0; k < links; ++k) {
    double moment = 0;
    for (int below = k; below < links; ++below)
      moment += mass * g * (at[static_cast<std::size_t>(below)] - joint[static_cast<std::size_t>(k)]);
    CAPTURE(k);
    CHECK(std::abs(moment) <= (1 + 1e-6) * mu * radius * mass * g * (links - k));
  }
}

}  // namespace test_long_chain
