// The same machine in metres and kilograms, in millimetres and tonnes, and in kilometres and grams has the same motion.
//
// Lengths by L, masses by M, times as they are: forces by M L, moments and energies by M L^2, stiffnesses by M,
// inertias by M L^2. SI-dependent constants of the program (scalings of constraints, tolerances) would show.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using bielle::test::move_to;
using Eigen::Vector3d;

namespace {

/// Returns a crank with a universal joint, a spatial loop with a rod, a screw, a gear, a rope: redundant constraints as
/// well.
std::string machine(double L, double M) {
  const auto at = [&](double x, double y, double z) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", L * x, L * y, L * z);
  };
  const std::string inertia =
      fmt::format("[{0:.17g}, {1:.17g}, {2:.17g}]", 0.01 * M * L * L, 0.02 * M * L * L, 0.015 * M * L * L);
  const auto body = [&](const std::string& name) {
    return fmt::format("  b_{0}: {{type: rigid_body, node: {0}, mass: {1:.17g}, inertia: {2}}}\n", name, 2 * M,
                       inertia);
  };
  return fmt::format("gravity: [0, 0, {:.17g}]\nnodes:\n", -9.81 * L) + "  crank: {position: " + at(0, 0, 0) + "}\n" +
         "  shaft: {position: " + at(0, 0, 0) + "}\n  coupler: {position: " + at(0.3, 0, 0) +
         "}\n  rocker: {position: " + at(0.8, 0.2, 0) + "}\n  nut: {position: " + at(0, -0.5, 0) +
         "}\n  bob: {position: " + at(1, 1, -0.5) + "}\n" + "elements:\n" + body("crank") + body("shaft") +
         body("coupler") + body("rocker") + body("nut") + body("bob") +
         "joints:\n  main: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1]}\n" +
         "  bearing: {type: hinge, nodes: [ground, shaft], axis: [0.5, 0, 0.8660254037844386]}\n" +
         "  cross: {type: universal, nodes: [crank, shaft], axis: [0, 1, 0], second_axis: [0.8660254037844386, 0, "
         "-0.5]}\n" +
         "  pin: {type: hinge, nodes: [crank, coupler], axis: [0, 0, 1]}\n" +
         "  pivot: {type: hinge, nodes: [ground, rocker], axis: [0.1, 0, 1]}\n" +
         "  rod: {type: distance, nodes: [coupler, rocker], at: [" + at(0, 0, 0) + ", " + at(-0.1, 0.3, 0.1) + "]}\n" +
         "  thread: {type: screw, nodes: [ground, nut], axis: [0, 0, 1], pitch: " + fmt::format("{:.17g}", 0.05 * L) +
         "}\n" + "  gear: {type: gear, joints: [main, thread.angle], ratio: -0.7}\n" +
         "  rope: {type: cable, nodes: [rocker, bob], radii: [0, 0], at: [" + at(0, 0.1, 0) + ", " + at(0, 0, 0.05) +
         fmt::format("], EA: {:.17g}, damping: 0.001}}\n", 3e3 * M * L) +
         fmt::format("drives: {{motor: {{joint: main, torque: \"{:.17g}*cos(3*t)\"}}}}\n", 4 * M * L * L);
}

}  // namespace

TEST_CASE("units of length and mass change no motion") {
  struct Seen {
    double angle, energy, rod;
    Vector3d bob;
  };
  const auto run = [](double L, double M) {
    Seen seen{};
    move_to(machine(L, M), 2e-3, 0.6, [&](const Session& session) {
      seen = {session.read("joints/main/coordinate")[0], session.energy().kinetic / (M * L * L),
              session.read("joints/rod/reaction_inertial")[0] / (M * L), session.node("bob").x / L};
    });
    return seen;
  };
  const Seen si = run(1, 1);
  CHECK(std::abs(si.angle) > 0.1);
  for (const auto& [L, M] : {std::pair{1000.0, 1e-3}, {1e-3, 1e3}, {1e-3, 1e-6}, {1e6, 1.0}}) {
    CAPTURE(L, M);
    const Seen other = run(L, M);
    // The difference is Newton's tolerance, relative to the acting forces, after 600 steps.
    CHECK(other.angle == Approx(si.angle).epsilon(1e-6));
    CHECK(other.energy == Approx(si.energy).epsilon(1e-6));
    CHECK(other.rod == Approx(si.rod).epsilon(1e-5));
    CHECK((other.bob - si.bob).norm() < 1e-6);
  }
}
