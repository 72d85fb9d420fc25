// Modes of small mechanisms against closed forms.
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

constexpr double g = 9.81;

std::string rod(const std::string& name, double length) {
  return fmt::format("  {}: {{type: rigid_body, node: {}, mass: 2, inertia: [{}, {}, 1e-3]}}\n", name, name,
                     2 * length * length / 12, 2 * length * length / 12);
}

}  // namespace

TEST_CASE("a compound pendulum swings with sqrt(m g c / J), whichever way it is held", "[linearised]") {
  // A rod of length 1 about its end: omega^2 = m g (1/2) / (m/3). A cylindrical and a spherical joint in a plane hold
  // it as well.
  const std::string head =
      "gravity: [0, 0, -9.81]\nnodes: {rod: {position: [0, 0, -0.5]}}\nelements:\n" + rod("rod", 1);
  for (const char* joint : {"{type: hinge, nodes: [ground, rod], position: [0, 0, 0], axis: [0, 1, 0]}",
                            "{type: hinge, nodes: [rod, ground], at: [[0, 0, 0.5], [0, 0, 0]], axis: [0, 1, 0]}"}) {
    const ModesReport report = ModesOf(head + "joints:\n  pivot: " + joint + "\n")();
    CHECK(report.found.all);
    CHECK(report.unbalance < 1e-12);
    check_rates(rates_of(report), {std::sqrt(1.5 * g)}, 1e-12);
    CHECK(std::abs(report.found.modes[0].damping_ratio()) < 1e-12);
    CHECK(report.found.modes[0].residual < 1e-11);
  }
}

TEST_CASE("a pendulum on its head grows as it falls", "[linearised]") {
  const ModesReport report =
      ModesOf("gravity: [0, 0, -9.81]\nnodes: {rod: {position: [0, 0, 0.5]}}\nelements:\n" + rod("rod", 1) +
              "joints:\n  pivot: {type: hinge, nodes: [ground, rod], position: [0, 0, 0], axis: [0, 1, 0]}\n")();
  REQUIRE(report.found.modes.size() == 2);
  const bool first_grows = report.found.modes[0].s.real() > 0;
  const Mode &growing = report.found.modes[first_grows ? 0 : 1], &decaying = report.found.modes[first_grows ? 1 : 0];
  CHECK(growing.kind == ModeKind::growing);
  CHECK(decaying.kind == ModeKind::decaying);
  CHECK(growing.s.real() == Approx(std::sqrt(1.5 * g)).epsilon(1e-12));
  CHECK(decaying.s.real() == Approx(-std::sqrt(1.5 * g)).epsilon(1e-12));
  CHECK(growing.s.imag() == 0);
}

TEST_CASE("a double pendulum of points has omega^2 = g/l (2 -+ sqrt 2)", "[linearised]") {
  const std::string text =
      "gravity: [0, 0, -9.81]\n"
      "nodes:\n  a: {position: [0, 0, -1], fixed: [y, rx, ry, rz]}\n  b: {position: [0, 0, -2], fixed: [y, rx, ry, "
      "rz]}\n"
      "elements:\n  a: {type: point_mass, node: a, mass: 3}\n  b: {type: point_mass, node: b, mass: 3}\n"
      "joints:\n  upper: {type: distance, nodes: [ground, a], at: [[0, 0, 0], [0, 0, 0]], length: 1}\n"
      "  lower: {type: distance, nodes: [a, b], at: [[0, 0, 0], [0, 0, 0]], length: 1}\n";
  const std::vector<double> exact = {std::sqrt(g * (2 - std::sqrt(2.0))), std::sqrt(g * (2 + std::sqrt(2.0)))};
  const ModesReport report = ModesOf(text)();
  CHECK(report.found.all);
  check_rates(rates_of(report), exact, 1e-12);
  // The lower rod turns by +- sqrt 2 of the upper one.
  for (int k : {0, 1}) {
    const NodeShapes shapes = node_shapes(ModesOf(text).session.system(), report.about.state,
                                          report.found.modes[static_cast<std::size_t>(k)]);
    const std::complex<double> ratio = shapes.displacement(0, 2) / shapes.displacement(0, 1);
    CHECK(std::abs(ratio - (1 + (k == 0 ? std::sqrt(2.0) : -std::sqrt(2.0)))) < 1e-9);
  }
}

TEST_CASE("a damped oscillator has s = -zeta w -+ w sqrt(zeta^2 - 1), below and above critical damping",
          "[linearised]") {
  constexpr double w = 20;
  const auto text = [](double zeta) {
    return fmt::format(
        "nodes: {{m: {{position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}}}\n"
        "elements:\n  m: {{type: point_mass, node: m, mass: 2}}\n"
        "  s: {{type: spring_damper, nodes: [ground, m], stiffness: {}, damping: {}}}\n",
        2 * w * w, 2 * 2 * zeta * w);
  };
  const ModesReport below = ModesOf(text(0.3))();
  REQUIRE(below.found.modes.size() == 1);
  CHECK(below.found.modes[0].kind == ModeKind::oscillating);
  CHECK(below.found.modes[0].frequency() == Approx(w / two_pi).epsilon(1e-12));
  CHECK(below.found.modes[0].damping_ratio() == Approx(0.3).epsilon(1e-12));
  CHECK(below.found.modes[0].damped_frequency() == Approx(w * std::sqrt(1 - 0.09) / two_pi).epsilon(1e-12));
  const ModesReport above = ModesOf(text(3))();
  REQUIRE(above.found.modes.size() == 2);
  CHECK(above.found.modes[0].s.real() == Approx(-w * (3 - std::sqrt(8.0))).epsilon(1e-11));
  CHECK(above.found.modes[1].s.real() == Approx(-w * (3 + std::sqrt(8.0))).epsilon(1e-11));
  for (const Mode& mode : above.found.modes) CHECK(mode.kind == ModeKind::decaying);
}

TEST_CASE("the modes of oscillators far apart are all found to rounding", "[linearised]") {
  // One model has frequencies over eight powers of ten.
  std::string nodes = "nodes:\n", elements = "elements:\n";
  std::vector<double> exact;
  for (int k = 0; k < 9; ++k) {
    const double w = 0.1 * std::pow(10, k);
    exact.push_back(w);
    nodes += fmt::format("  m{}: {{position: [1, {}, 0], fixed: [y, z, rx, ry, rz]}}\n", k, k);
    elements += fmt::format("  m{0}: {{type: point_mass, node: m{0}, mass: 3}}\n", k);
    elements += fmt::format(
        "  s{0}: {{type: spring_damper, nodes: [ground, m{0}], at: [[0, {0}, 0], [0, 0, 0]], stiffness: {1}}}\n", k,
        3 * w * w);
  }
  // Eigenvalues 1e5 times as large as the smallest one are accurate to 1e-16 * 1e5 relative, and so on, because they
  // are small in the inverse.
  check_rates(rates_of(nodes + elements, {.count = 6}), {exact.begin(), exact.begin() + 6}, 1e-10);
}

TEST_CASE("rigid modes are counted by shapes and are zero, not noise", "[linearised]") {
  const std::string body = "{type: rigid_body, node: b, mass: 3, centre: [0.1, 0.2, 0], inertia: [0.1, 0.2, 0.25]}";
  for (const auto& [node, joints, count] :
       {std::tuple{"{position: [0.3, 0, -1]}", "", 6},
        std::tuple{"{position: [0.3, 0, -1], fixed: [z, rx, ry]}", "", 3},
        std::tuple{"{position: [0.3, 0, -1]}", "joints:\n  j: {type: spherical, nodes: [ground, b]}\n", 3},
        std::tuple{"{position: [0.3, 0, -1]}",
                   "joints:\n  j: {type: cylindrical, nodes: [ground, b], axis: [1, 1, 0]}\n", 2}}) {
    const ModesReport report = ModesOf(fmt::format("nodes: {{b: {}}}\nelements: {{b: {}}}\n{}", node, body, joints))();
    CHECK(report.found.all);
    CHECK(count_rigid(report) == count);
    CHECK(report.found.modes.size() == static_cast<std::size_t>(count));
    for (const Mode& mode : report.found.modes) CHECK(mode.s == 0.0);
  }
}

TEST_CASE("two free bodies on a spring have six rigid modes, five more turns, and one frequency", "[linearised]") {
  // The spring between the centres acts on their distance alone: of 12 motions, 11 are free.
  const ModesReport report = ModesOf(
      "nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 2, 2]}}\n"
      "elements:\n  a: {type: rigid_body, node: a, mass: 2, inertia: [1, 2, 2]}\n"
      "  b: {type: rigid_body, node: b, mass: 6, inertia: [1, 2, 2]}\n"
      "  s: {type: spring_damper, nodes: [a, b], stiffness: 150}\n")();
  CHECK(count_rigid(report) == 11);
  check_rates(rates_of(report), {std::sqrt(150 * (1 / 2.0 + 1 / 6.0))}, 1e-12);
}

TEST_CASE("redundant constraints change no mode", "[linearised]") {
  const std::string model =
      "gravity: [0, 0, -9.81]\nnodes: {rod: {position: [0, 0, -0.5]}}\nelements:\n" + rod("rod", 1) +
      "joints:\n  pivot: {type: hinge, nodes: [ground, rod], position: [0, 0, 0], axis: [0, 1, 0]}\n";
  const ModesOf twice(model +
                      "  second: {type: hinge, nodes: [ground, rod], position: [0, 0.3, 0], axis: [0, 1, 0]}\n");
  CHECK(twice.session.redundant().size() == 1);
  check_rates(rates_of(twice()), {std::sqrt(1.5 * g)}, 1e-12);
}

TEST_CASE("first-order unknowns have modes of their own", "[linearised]") {
  // T z' = -z: s = -1/T. The integral of zero is a rigid mode: it may have any value.
  const ModesReport report = ModesOf(
      "nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
      "elements: {m: {type: point_mass, node: m, mass: 2}, s: {type: spring_damper, nodes: [ground, m], stiffness: "
      "50}}\n"
      "states: {slow: {rate: \"-slow/0.25\", start: 0}}\n")();
  REQUIRE(report.found.modes.size() == 2);
  CHECK(report.found.modes[0].s.real() == Approx(-4).epsilon(1e-12));
  CHECK(report.found.modes[0].kind == ModeKind::decaying);
  CHECK(std::abs(report.found.modes[1].s) == Approx(5).epsilon(1e-12));
}

TEST_CASE("a massless node between two springs has no mode of its own", "[linearised]") {
  // 1/k = 1/k_1 + 1/k_2.
  const ModesReport report = ModesOf(
      "nodes: {m: {position: [2, 0, 0], fixed: [y, z, rx, ry, rz]}, between: {position: [1, 0, 0], fixed: [y, z, rx, "
      "ry, rz]}}\n"
      "elements:\n  m: {type: point_mass, node: m, mass: 2}\n"
      "  s: {type: spring_damper, nodes: [ground, between], stiffness: 300}\n"
      "  t: {type: spring_damper, nodes: [between, m], stiffness: 600}\n")();
  CHECK(report.found.all);
  check_rates(rates_of(report), {10}, 1e-12);
}

TEST_CASE("`near` finds the modes around a frequency, `below` all up to one", "[linearised]") {
  std::string nodes = "nodes:\n", elements = "elements:\n";
  for (int k = 1; k <= 12; ++k) {
    nodes += fmt::format("  m{}: {{position: [1, {}, 0], fixed: [y, z, rx, ry, rz]}}\n", k, k);
    elements += fmt::format("  m{0}: {{type: point_mass, node: m{0}, mass: 1}}\n", k);
    elements += fmt::format(
        "  s{0}: {{type: spring_damper, nodes: [ground, m{0}], at: [[0, {0}, 0], [0, 0, 0]], stiffness: {1}}}\n", k,
        std::pow(two_pi * k, 2));
  }
  const auto frequencies = [&](const ModeOptions& options) {
    std::vector<double> found;
    for (const Mode& mode : ModesOf(nodes + elements)(options).found.modes) found.push_back(mode.frequency());
    return found;
  };
  check_rates(frequencies({.count = 3, .near = 8.1}), {7, 8, 9}, 1e-11);
  check_rates(frequencies({.below = 4.5}), {1, 2, 3, 4}, 1e-11);
  check_rates(frequencies({.count = 2}), {1, 2}, 1e-11);
  for (const int dense : {0, 300}) CHECK(frequencies({.count = 12, .dense = dense}).size() == 12);
}

TEST_CASE("teeth without play have their stiffness once, also without a load", "[linearised]") {
  // The normal of the teeth is at the pressure angle to the tangent: w^2 = k cos^2(20 deg) (r1^2/J1 + r2^2/J2).
  constexpr double k = 4e8, r1 = 0.03, r2 = 0.075, J1 = 1e-3, J2 = 2e-2;
  const double expected = std::cos(std::numbers::pi / 9) * std::sqrt(k * (r1 * r1 / J1 + r2 * r2 / J2));
  for (const double torque : {0.0, 1e-9, 12.0, -12.0}) {
    CAPTURE(torque);
    const std::vector<double> found = rates_of(
        fmt::format(
            "nodes: {{p: {{}}, g: {{position: [0.105, 0, 0]}}}}\n"
            "elements:\n"
            "  p: {{type: rigid_body, node: p, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}\n"
            "  g: {{type: rigid_body, node: g, mass: 1, inertia: [2e-2, 2e-2, 2e-2]}}\n"
            "joints:\n"
            "  jp: {{type: hinge, nodes: [ground, p], axis: [0, 0, 1]}}\n"
            "  jg: {{type: hinge, nodes: [ground, g], axis: [0, 0, 1]}}\n"
            "  teeth: {{type: gear_mesh, nodes: [p, g], axes: [0, 0, 1], radii: [0.03, 0.075], stiffness: 4e8}}\n"
            "loads:\n"
            "  one: {{node: p, moment: [0, 0, {0}]}}\n"
            "  other: {{node: g, moment: [0, 0, {1}]}}\n",
            torque, torque * r2 / r1),
        {}, true);
    REQUIRE(found.size() == 1);
    CHECK(found[0] == Approx(expected).epsilon(1e-6));
  }
}
