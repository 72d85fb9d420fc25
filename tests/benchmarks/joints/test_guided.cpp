// Points on curves, and sliders on beams.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/runge_kutta.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Vector2 = Eigen::Vector2d;

namespace {

/// A circle of radius 1 in the xz plane through n points, as a file.
std::string circle_file(const bielle::test::TemporaryFolder& folder, int n) {
  const std::string path = folder.path() + "/circle.csv";
  std::ofstream out(path);
  for (int k = 0; k < n; ++k)
    out << fmt::format("{:.17g}, 0, {:.17g}\n", std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n));
  return path;
}

}  // namespace

TEST_CASE("a bead on a circular wire swings over the top as a pendulum, with order two and counted rounds") {
  const bielle::test::TemporaryFolder folder;
  const std::string path = circle_file(folder, 2000);  // the spline's curvature is right to (2 pi/2000)^2/12 = 8e-7
  const std::string text = fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{bead: {{position: [1, 0, 0], velocity: [0, 0, 7.5], fixed: [rx, ry, rz]}}}}
elements: {{m: {{type: point_mass, node: bead, mass: 2}}}}
joints: {{wire: {{type: point_on_curve, nodes: [ground, bead], curve: "{}", closed: true}}}}
)yaml",
                                       path);
  Vector2 z(0, 7.5);  // angle from x, rate
  bielle::test::advance_by_runge_kutta(z, 2.0, 8000, [](const Vector2& y) -> Vector2 {
    return {y[1], -9.81 * std::cos(y[0])};
  });
  REQUIRE(z[0] > 2 * M_PI);  // once round at least
  // Towards the middle, less the component of the weight.
  const double force = 2 * (z[1] * z[1] - 9.81 * std::sin(z[0]));
  const auto error = [&](double h) {
    Eigen::VectorXd left(3);
    move_to(text, h, 2.0, [&](const Session& session) {
      const std::vector<double> f = session.read("joints/wire/reaction_inertial");
      left << session.read("joints/wire/coordinate")[0] - z[0], session.read("joints/wire/rate")[0] - z[1],
          0.01 * (-f[0] * std::cos(z[0]) - f[2] * std::sin(z[0]) - force);
    });
    return left;
  };
  bielle::test::check_second_order(error, 0.004, 2, 0.15, 0.15);
}

TEST_CASE("a slider on a simply supported beam bends it as a load at its place, wherever it stands") {
  // w(a) = P a^2 b^2/(3 E I l) under the load (S. Timoshenko, Strength of Materials): small deflection of a slender
  // beam.
  const double E = 2e11, width = 0.02, I = std::pow(width, 4) / 12, l = 2;
  for (const double share : {0.125, 0.25, 0.3, 0.5, 0.81}) {
    const std::string text = fmt::format(R"yaml(
nodes:
  a: {{fixed: [x, y, z, rx, rz]}}
  b: {{position: [2, 0, 0], fixed: [y, z]}}
  s: {{position: [{:.17g}, 0, 0], fixed: [x, rx, ry, rz]}}
elements:
  beam: {{type: beam, nodes: [a, b], elements: 8, orientation: [0, 1, 0],
         section: {{EA: 8e7, GAy: 3e9, GAz: 3e9, GJ: 1e3, EIy: {:.17g}, EIz: {:.17g}, mass_per_length: 3, Jx: 1e-4, Jy: 1e-4, Jz: 1e-4}}}}
joints:
  ring: {{type: slider, node: s, beam: beam}}
loads: {{weight: {{node: s, force: [0, 0, -10]}}}}
)yaml",
                                         share * l, E * I, E * I);
    const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    compute_statics(session);
    const double a = share * l, b = l - a, w = 10 * a * a * b * b / (3 * E * I * l);
    CAPTURE(share, w);
    // At nodes the beam is exact; within an element Hermite's curve has no kink in the curvature: the error is up to P
    // L^3/(192 E I), with L = l/8.
    const double lacking = 10 * std::pow(l / 8, 3) / (192 * E * I);
    CHECK(-session.node("s").x.z() == Approx(w).margin(1.05 * lacking + 1e-4 * w));
    CHECK(session.read("joints/ring/reaction_inertial")[2] == Approx(10).epsilon(1e-9));
  }
}

TEST_CASE("a mass that runs along a beam passes its elements as on a finer beam") {
  const auto passage = [](int elements) {
    const std::string text = fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {{fixed: [x, y, z, rx, rz]}}
  b: {{position: [2, 0, 0], fixed: [y, z]}}
  s: {{position: [0.05, 0, 0], velocity: [4, 0, 0], fixed: [rx, ry, rz]}}
elements:
  m: {{type: point_mass, node: s, mass: 1}}
  beam: {{type: beam, nodes: [a, b], elements: {}, orientation: [0, 1, 0],
         section: {{rectangle: [0.03, 0.01], young: 7e10, poisson: 0.3, density: 2700}}}}
joints: {{ring: {{type: slider, node: s, beam: beam}}}}
)yaml",
                                         elements);
    std::vector<double> path;
    move(text, 5e-4, 0.4, [&](const Session& session) {
      path.push_back(session.node("s").x.z());
      if (path.size() == 800) path.push_back(session.node("s").x.x());
    });
    return path;
  };
  const std::vector<double> coarse = passage(6), middle = passage(12), fine = passage(24);
  double deepest = 0, off_coarse = 0, off_middle = 0;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    deepest = std::max(deepest, std::abs(fine[k]) * (k < 800 ? 1 : 0));
    off_coarse = std::max(off_coarse, std::abs(coarse[k] - fine[k]));
    off_middle = std::max(off_middle, std::abs(middle[k] - fine[k]));
  }
  CAPTURE(deepest, off_coarse, off_middle);
  CHECK(deepest > 0.01);
  CHECK(off_middle < 0.25 * off_coarse);
  CHECK(off_middle < 0.01 * deepest);
}

TEST_CASE("a slider that leaves its beam ends the run: with an error, or with an event") {
  const std::string text = R"yaml(
nodes:
  a: {fixed: true}
  b: {position: [2, 0, 0], fixed: true}
  s: {position: [1.5, 0, 0], velocity: [1, 0, 0], fixed: [rx, ry, rz]}
elements:
  m: {type: point_mass, node: s, mass: 1}
  beam: {type: beam, nodes: [a, b], elements: 4, section: {circle: 0.02, young: 7e10, poisson: 0.3, density: 2700}}
joints: {ring: {type: slider, node: s, beam: beam}}
)yaml";
  const auto run = [](const std::string& model) {
    double time = 0;
    move(model, 0.01, 1, [&](const Session& session) { time = session.time(); });
    return time;
  };
  CHECK_THROWS_WITH(run(text), Catch::Contains("slider 'ring' leaves its beam at the end"));
  std::string stopping = text;
  stopping.replace(stopping.find("beam: beam}"), 11, "beam: beam, ends: stop}");
  CHECK(run(stopping) == Approx(0.5).epsilon(1e-6));
}
