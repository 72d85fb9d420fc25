// The verdict on an equilibrium does not depend on units, and hanging and standing pendulums have one.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

namespace {

StaticsReport run(const std::string& text, int steps = 1) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  StaticsOptions options;
  options.steps = steps;
  return compute_statics(session, options);
}

/// Returns rods of mass 2 below each other, or above each other where l is negative.
std::string rods(int count, double l, const std::string& joint) {
  std::string nodes, elements, joints;
  for (int k = 0; k < count; ++k) {
    const double from = -k * l;
    nodes += fmt::format("  r{}: {{position: [0, 0, {:.17g}]}}\n", k, from - l / 2);
    elements +=
        fmt::format("  r{0}: {{type: rigid_body, node: r{0}, mass: 2, inertia: [{1:.17g}, {1:.17g}, {2:.17g}]}}\n", k,
                    l * l / 6, l * l / 600);
    joints += fmt::format("  j{}: {{nodes: [{}, r{}], position: [0, 0, {:.17g}], {}}}\n", k,
                          k == 0 ? "ground" : fmt::format("r{}", k - 1), k, from, joint);
  }
  return "gravity: [0, 0, -9.81]\nnodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints;
}

const std::string hinge = "type: hinge, axis: [0, 1, 0]", ball = "type: spherical";

}  // namespace

TEST_CASE("hanging pendulums are stable, standing ones unstable along each motion, whatever their size") {
  // The potential energy of n rods is m g l sum_k (n - k + 1/2)(1 - cos): each angle has a positive stiffness if the
  // rods hang, and a negative one if they stand. Spherical joints let each rod swing in two planes and spin about
  // itself, which needs no energy.
  for (const double l : {1.0, 1e-3, 1e3})
    for (const int count : {1, 2, 5})
      for (const std::string& joint : {hinge, ball}) {
        CAPTURE(l, count, joint);
        const int motions = joint == hinge ? count : 2 * count;
        const StaticsReport hanging = run(rods(count, l, joint)), standing = run(rods(count, -l, joint));
        REQUIRE(hanging.log.unstable);
        CHECK(*hanging.log.unstable == 0);
        REQUIRE(standing.log.unstable);
        CHECK(*standing.log.unstable == motions);
        CHECK(hanging.log.loose.empty() == (joint == hinge));
        CHECK(standing.log.loose.empty() == (joint == hinge));
      }
}

TEST_CASE("a rod that slides freely along its axle is indifferent and makes nothing unstable") {
  // The rods are those of the case above, in oblique axes; the second of three rods slides. With compliant joints the
  // weight would move it down.
  for (const double l : {1.0, 0.05, 20.0})
    for (const double sign : {1.0, -1.0})
      for (const char* axle : {"[0, 1, 0]", "[0.64, 0.6, -0.48]"}) {
        CAPTURE(l, sign, axle);
        std::string nodes, elements, joints;
        for (int k = 0; k < 3; ++k) {
          const double at = sign * k * l, half = sign * (k + 0.5) * l;
          nodes += fmt::format("  r{}: {{position: [{:.17g}, 0, {:.17g}]}}\n", k, 0.6 * half, 0.8 * half);
          elements += fmt::format("  r{0}: {{type: rigid_body, node: r{0}, mass: 2, inertia: [{1}, {1}, {1}]}}\n", k,
                                  l * l / 6);
          joints += fmt::format("  j{}: {{type: {}, nodes: [{}, r{}], position: [{:.17g}, 0, {:.17g}], axis: {}}}\n", k,
                                k == 1 ? "cylindrical" : "hinge", k == 0 ? "ground" : fmt::format("r{}", k - 1), k,
                                0.6 * at, 0.8 * at, axle);
        }
        const StaticsReport report = run("gravity: [\"9.81*0.6\", 0, \"9.81*0.8\"]\nnodes:\n" + nodes + "elements:\n" +
                                         elements + "joints:\n" + joints);
        CHECK(report.log.unstable == (sign > 0 ? 0 : 3));
        CHECK_FALSE(report.log.loose.empty());
      }
}

TEST_CASE("a pendulum's verdict counts its spring, whatever its size") {
  // The inverted pendulum is stable if the stiffness of its spring exceeds m g l/2.
  for (const double l : {1e-3, 1.0, 1e3})
    for (const double share : {0.9, 0.999, 1.001, 1.1}) {
      CAPTURE(l, share);
      const StaticsReport report =
          run(rods(1, -l, hinge + fmt::format(", stiffness: {:.17g}", share * 2 * 9.81 * l / 2)));
      REQUIRE(report.log.unstable);
      CHECK(*report.log.unstable == (share < 1 ? 1 : 0));
    }
}

TEST_CASE("the verdict on a beam that a moment rolls up is the same in all units of length") {
  // A moment about an axis fixed in space has no potential if its node turns in space (H. Ziegler, Principles of
  // Structural Stability, 1968), so that negative directions are not counted there. In a plane it has a potential.
  const auto rolled = [](double S, double phi, const std::string& fixed) {
    return run(fmt::format("nodes: {{a: {{fixed: true}}, b: {{position: [{0:.17g}, 0, 0], fixed: {2}}}}}\n"
                           "elements: {{w: {{type: beam, nodes: [a, b], elements: 16, section: {{EA: 1e6, GAy: 1e6, "
                           "GAz: 1e6, GJ: {1:.17g}, EIy: {1:.17g}, EIz: {1:.17g}}}}}}}\n"
                           "loads: {{m: {{node: b, moment: [0, 0, {3:.17g}]}}}}\n",
                           S, S * S, fixed, S * phi))
        .log.unstable;
  };
  for (const double phi : {std::numbers::pi, 12.0})
    for (const double S : {1e-4, 1e-2, 1.0, 1e2, 1e4}) {
      CAPTURE(phi, S);
      CHECK_FALSE(rolled(S, phi, "[z]"));
      CHECK(rolled(S, phi, "[z, rx, ry]").has_value());
    }
}
