// Kinematics with steps that are large compared with the distance of two branches of a mechanism.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

namespace {

/// A crank of radius r turns a rod of length l, whose end slides along x.
std::string slider_crank(double r, double l, const std::string& angle) {
  return fmt::format(
      "nodes: {{c: {{position: [0, 0, 0]}}, d: {{position: [{0}, 0, 0]}}, p: {{position: [{1}, 0, 0]}}}}\n"
      "joints:\n  main: {{type: hinge, nodes: [ground, c], position: [0, 0, 0], axis: [0, 0, 1]}}\n"
      "  pin: {{type: hinge, nodes: [c, d], position: [{0}, 0, 0], axis: [0, 0, 1]}}\n"
      "  gud: {{type: hinge, nodes: [d, p], position: [{1}, 0, 0], axis: [0, 0, 1]}}\n"
      "  sl: {{type: prismatic, nodes: [ground, p], position: [{1}, 0, 0], axis: [1, 0, 0]}}\n"
      "drives: {{m: {{joint: main, angle: \"{2}\"}}}}\n",
      r, r + l, angle);
}

}  // namespace

TEST_CASE("a slider-crank keeps its branch however near it comes to its dead centre, whatever the step") {
  // x = r cos a + sqrt(l^2 - r^2 sin^2 a); with r < l the branch with the other sign cannot be reached.
  const double l = 0.3, w = 10;
  for (const double r : {0.1, 0.29, 0.2999, 0.299999})
    for (const double step : {0.01, 0.03}) {
      CAPTURE(r, step);
      const MechanismFile file = read_mechanism_text(slider_crank(r, l, fmt::format("{}*t", w)), "model.yaml");
      Session session(file.model);
      session.on_step([&](Session& at) {
        const double a = w * at.time(), height = r * std::sin(a);
        CHECK(at.node("p").x[0] == Approx(r * std::cos(a) + std::sqrt(l * l - height * height)).margin(1e-9));
      });
      compute_kinematics(session, {.duration = 1.3, .step = step});
    }
}

TEST_CASE("a parallelogram goes on through its change points as it was driven into them") {
  // Links of 0.1 m, coupler and base of 0.3 m: they are in line at 0 and pi, where the determinant changes its sign.
  // The rocker turns with the crank.
  const MechanismFile file = read_mechanism_text(
      "nodes: {c: {position: [0, 0, 0], rotation_vector: [0, 0, 1]}, k: {position: [0.054030230586814, "
      "0.0841470984807897, 0]}, "
      "o: {position: [0.3, 0, 0]}}\n"
      "joints:\n  main: {type: hinge, nodes: [ground, c], position: [0, 0, 0], axis: [0, 0, 1]}\n"
      "  pin: {type: hinge, nodes: [c, k], position: [0.054030230586814, 0.0841470984807897, 0], axis: [0, 0, 1]}\n"
      "  pit: {type: hinge, nodes: [k, o], position: [0.354030230586814, 0.0841470984807897, 0], axis: [0, 0, 1]}\n"
      "  out: {type: hinge, nodes: [ground, o], position: [0.3, 0, 0], axis: [0, 0, 1]}\n"
      "drives: {m: {joint: main, angle: \"10*t\"}}\n",
      "model.yaml");
  for (const double step : {0.01, 0.03}) {
    CAPTURE(step);
    Session session(file.model);
    session.on_step(
        [&](Session& at) { CHECK(at.read("joints/out/coordinate")[0] == Approx(10 * at.time()).margin(1e-6)); });
    compute_kinematics(session, {.duration = 2, .step = step});
  }
}
