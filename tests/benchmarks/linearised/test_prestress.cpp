// Modes of loaded beams: strings, columns, follower forces. EI = m = L = 1.
#include <numbers>

#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using std::numbers::pi;

namespace {

/// The motion is in the plane x y: bending out of it is a hundred times as fast.
std::string plane_beam(const std::string& a, const std::string& b, const std::string& loads, int elements = 24) {
  return fmt::format(
      "nodes: {{a: {{position: [0, 0, 0], {}}}, b: {{position: [1, 0, 0], {}}}}}\n"
      "elements:\n  b: {{type: beam, nodes: [a, b], elements: {}, orientation: [0, 1, 0], section: {{EA: 1e7, GAy: "
      "1e8, GAz: 1e8, GJ: "
      "1e4, EIy: 1e4, EIz: 1, mass_per_length: 1, Jx: 1e-7, Jy: 1e-8, Jz: 1e-8}}}}\n{}",
      a, b, elements, loads);
}

const std::string clamped = "fixed: true", hinged = "fixed: [x, y, z, rx, ry]", sliding = "fixed: [y, z, rx, ry]",
                  free_end = "fixed: [z, rx, ry]";

std::string axial(double force, bool follower) {
  return fmt::format("loads: {{p: {{node: b, force: [{}, 0, 0], follower: {}}}}}\n", force, follower);
}

}  // namespace

TEST_CASE("a stretched beam on two hinges has a string's frequencies, stiffened by bending", "[linearised]") {
  // omega_n = n pi sqrt(n^2 pi^2 + T)
  const double T = 1000;
  const std::vector<double> found = rates_of(plane_beam(hinged, sliding, axial(T, false)), {.count = 4}, true);
  std::vector<double> exact;
  constexpr double pi = std::numbers::pi;
  for (int n = 1; n <= 4; ++n) exact.push_back(n * pi * std::sqrt(n * n * pi * pi + T));
  // The stretched beam is longer by T/EA = 1e-4.
  check_rates(found, exact, 1e-3);
}

TEST_CASE("a column's frequency goes to zero at Euler's load and becomes growth beyond", "[linearised]") {
  // Hinged column: omega^2 = pi^4 (1 - P/Pcr), Pcr = pi^2.
  constexpr double pi = std::numbers::pi, Pcr = pi * pi;
  for (const double part : {0.5, 0.9, 0.99, 1.01, 1.2}) {
    const ModesReport report = ModesOf(plane_beam(hinged, sliding, axial(-part * Pcr, false)), true)({.count = 1});
    CAPTURE(part);
    REQUIRE(!report.found.modes.empty());
    const std::complex<double> s = report.found.modes[0].s;
    // The errors of the critical load by the mesh and by compression, about 1e-5 of it, are this fraction of omega^2.
    CHECK((s * s).real() == Approx(-std::pow(pi, 4) * (1 - part)).margin(std::pow(pi, 4) * 1e-4));
    CHECK((report.found.modes[0].kind == ModeKind::oscillating) == (part < 1));
  }
}

TEST_CASE("Beck's column flutters from P = 20.0509 EI/L^2 on", "[linearised]") {
  // M. Beck, ZAMP 3 (1952) 225; V. Bolotin, Nonconservative Problems (1963): a follower force at the free end.
  const auto least_damping = [](double P) {
    const ModesReport report = ModesOf(plane_beam(clamped, free_end, axial(-P, true), 16), true)({.count = 2});
    double least = 1;
    for (const Mode& mode : report.found.modes) least = std::min(least, mode.damping_ratio());
    return least;
  };
  CHECK(std::abs(least_damping(19.9)) < 1e-7);
  CHECK(std::abs(least_damping(20.0)) < 1e-7);
  CHECK(least_damping(20.1) < -1e-3);
  CHECK(least_damping(25) < -0.1);
  // The two frequencies meet at 11.0156.
  const std::vector<double> near = rates_of(plane_beam(clamped, free_end, axial(-20.04, true), 16), {.count = 2}, true);
  CHECK(0.5 * (near[0] + near[1]) == Approx(11.0156).epsilon(2e-3));
}

TEST_CASE("a free beam has three rigid modes in its plane and the textbook's frequencies", "[linearised]") {
  // cos x cosh x = 1: x = 4.730040744862704, 7.853204624095838, 10.995607838001671.
  const ModesReport report = ModesOf(plane_beam("fixed: [z, rx, ry]", free_end, "", 48))({.count = 20});
  CHECK(count_rigid(report) == 5 - 2);
  std::vector<double> found = rates_of(report);
  found.resize(3);
  check_rates(found, {std::pow(4.730040744862704, 2), std::pow(7.853204624095838, 2), std::pow(10.995607838001671, 2)},
              1e-5);
}

TEST_CASE("large models go by ARPACK to the same modes, multiple ones included", "[linearised]") {
  // A free beam of equal stiffness in both planes: every bending mode twice, six rigid ones.
  const ModesOf beam(
      "nodes: {a: {position: [0, 0, 0]}, b: {position: [0.6, 0.8, 0]}}\n"
      "elements: {b: {type: beam, nodes: [a, b], elements: 12, section: {circle: 0.01, young: 2e11, poisson: 0.3, "
      "density: 7800}, "
      "damping: 1e-5}}\n");
  const ModesReport dense = beam({.count = 20}), sparse = beam({.count = 20, .dense = 0});
  CHECK(count_rigid(dense) == 6);
  CHECK(count_rigid(sparse) == 6);
  REQUIRE(dense.found.modes.size() == sparse.found.modes.size());
  for (std::size_t k = 0; k < dense.found.modes.size(); ++k) {
    CAPTURE(k);
    CHECK(std::abs(dense.found.modes[k].s - sparse.found.modes[k].s) <= 1e-8 * std::abs(dense.found.modes[k].s));
  }
}

TEST_CASE("a chain of elastic links with hinges has the same modes densely and by ARPACK", "[linearised]") {
  std::string nodes = "gravity: [0, 0, -9.81]\nnodes:\n", elements = "elements:\n", joints = "joints:\n";
  const int links = 12;
  for (int k = 0; k < links; ++k) {
    nodes += fmt::format("  a{0}: {{position: [0, 0, {1}]}}\n  b{0}: {{position: [0, 0, {2}]}}\n", k, -k, -k - 1);
    elements += fmt::format(
        "  l{0}: {{type: beam, nodes: [a{0}, b{0}], elements: 2, section: {{circle: 0.02, young: 7e10, poisson: 0.3, "
        "density: 2700}}}}\n",
        k);
    joints +=
        fmt::format("  h{0}: {{type: hinge, nodes: [{1}, a{0}], position: [0, 0, {2}], axis: {3}}}\n", k,
                    k == 0 ? std::string("ground") : fmt::format("b{}", k - 1), -k, k % 2 ? "[1, 0, 0]" : "[0, 1, 0]");
  }
  const ModesOf chain(nodes + elements + joints, true);
  const ModesReport dense = chain({.count = 15, .dense = 2000}), sparse = chain({.count = 15, .dense = 0});
  REQUIRE(dense.found.modes.size() == sparse.found.modes.size());
  CHECK(count_rigid(dense) == count_rigid(sparse));
  for (std::size_t k = 0; k < dense.found.modes.size(); ++k) {
    CAPTURE(k);
    CHECK(std::abs(dense.found.modes[k].s - sparse.found.modes[k].s) <= 1e-8 * std::abs(dense.found.modes[k].s));
  }
}
