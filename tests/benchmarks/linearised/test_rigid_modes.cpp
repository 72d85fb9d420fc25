// Rigid and neutral motions: they are distinguished from slow modes by the accuracy of their stiffness.
#include "mechanism/analyses/modes.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "reduce/superelement/superelement.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

/// Returns a free beam of unit mass, length and stiffness (EI = 1), obliquely in space, with a spring of force P (pulls
/// its ends together) between its own ends.
std::string tied_beam(double P, const std::string& element) {
  return fmt::format(
      "gravity: [0, 0, 0]\nnodes: {{a: {{position: [0, 0, 0]}}, b: {{position: [1, 0, 0]}}}}\n"
      "elements:\n  bar: {}\n  tie: {{type: spring_damper, nodes: [a, b], force: \"{} + 1e-3*e\"}}\n",
      element, P);
}

const std::string beam_of_elements =
    "{type: beam, nodes: [a, b], elements: 16, orientation: [0, 1, 0], section: {EA: 1e5, GAy: 1e7, GAz: 1e7, GJ: 0.8, "
    "EIy: 1.3, EIz: 1, mass_per_length: 1, Jx: 1e-4, Jy: 1e-9, Jz: 1e-9}}";

/// First symmetric frequency of a free beam under a compression P between its own ends, which acts along their
/// connection: w = A cosh(a x) + B cos(b x) with b^2 - a^2 = P/EI, a b = omega (m/EI)^1/2, no moment at the ends, and
/// EI w''' + P w' = 0 there:  b^3 tanh(a/2) + a^3 tan(b/2) = 0.
double first_frequency(double P, double EI) {
  const auto excess = [&](double omega) {
    const double p = P / EI, root = std::sqrt(p * p + 4 * omega * omega / EI);
    const double a = std::sqrt(0.5 * (root - p)), b = std::sqrt(0.5 * (root + p));
    return b * b * b * std::tanh(a / 2) * std::cos(b / 2) + a * a * a * std::sin(b / 2);
  };
  double low = 15, high = 28;
  const bool positive = excess(low) > 0;
  REQUIRE(positive != (excess(high) > 0));
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    ((excess(middle) > 0) == positive ? low : high) = middle;
  }
  return low;
}

void check_nothing_grows(const ModesReport& report) {
  for (const Mode& mode : report.found.modes) {
    CHECK(mode.kind != ModeKind::growing);
    CHECK(std::abs(mode.s.real()) <= std::max(mode.uncertainty, 1e-9 * std::abs(mode.s)));
  }
}

std::vector<double> first_of(std::vector<double> values, std::size_t count) {
  REQUIRE(values.size() >= count);
  values.resize(count);
  return values;
}

/// Returns rods of length l between ball joints along an oblique line, drawn by a force T at a slider at their end.
std::string taut_chain(int rods, double l, double m, double T) {
  const Eigen::Vector3d d = Eigen::Vector3d(2, -3, 6) / 7, e = Eigen::Vector3d(3, 2, 0).normalized();
  const auto list = [](const Eigen::Vector3d& x) { return fmt::format("[{}, {}, {}]", x[0], x[1], x[2]); };
  std::string nodes = fmt::format("nodes:\n  slider: {{position: {}}}\n", list(rods * l * d));
  std::string elements = "elements:\n  slider: {type: rigid_body, node: slider, mass: 3, inertia: [1, 1, 1]}\n";
  std::string joints =
      fmt::format("joints:\n  guide: {{type: prismatic, nodes: [ground, slider], axis: {}}}\n", list(d));
  for (int k = 0; k <= rods; ++k) {
    const std::string before = k == 0 ? "ground" : fmt::format("r{}", k - 1),
                      after = k == rods ? "slider" : fmt::format("r{}", k);
    joints +=
        fmt::format("  b{}: {{type: spherical, nodes: [{}, {}], position: {}}}\n", k, before, after, list(k * l * d));
    if (k == rods) break;
    nodes +=
        fmt::format("  r{}: {{position: {}, axes: {{x: {}, y: {}}}}}\n", k, list((k + 0.5) * l * d), list(d), list(e));
    elements += fmt::format("  r{0}: {{type: rigid_body, node: r{0}, mass: {1}, inertia: [{2}, {3}, {3}]}}\n", k, m,
                            1e-6 * m * l * l, m * l * l / 12);
  }
  return nodes + elements + joints + fmt::format("loads: {{pull: {{node: slider, force: {}}}}}\n", list(T * d));
}

}  // namespace

TEST_CASE("a free body that is stressed by a spring of its own keeps six rigid modes", "[linearised]") {
  const TemporaryFolder folder;
  write_superelement(straight_beam({}, 12).reduced().body, folder / "beam.h5");
  const std::string superelement =
      fmt::format("{{type: superelement, file: {}, nodes: {{a: a, b: b}}}}", folder / "beam.h5");
  for (const std::string& element : {beam_of_elements, superelement})
    for (const double P : {0.0, 1e-6, -1e-6, 2e-3, -2e-3, 2.0, -2.0}) {
      CAPTURE(element, P);
      const ModesReport report = ModesOf(tied_beam(P, element), true)({.count = 8});
      CHECK(count_rigid(report) == 6);
      CHECK(report.found.modes.size() == 6 + 8);  // `count` elastic modes in addition to the rigid ones
      CHECK_FALSE(report.found.all);
      check_nothing_grows(report);
      // The tolerance covers a compression by 2e-5 of the length, and the error of finite elements or modes.
      check_rates(first_of(rates_of(report), 2), {first_frequency(P, 1), first_frequency(P, 1.3)}, 4e-4);
      CHECK(report.found.modes[0].uncertainty < 1e-3);
    }
}

TEST_CASE("the slowest modes of a stressed free body are those that a search next to them finds", "[linearised]") {
  const ModesOf model(tied_beam(-2, beam_of_elements), true);
  for (const int dense : {0, 300}) {
    const std::vector<double> slowest = rates_of(model({.count = 6, .dense = dense})),
                              near = rates_of(model({.count = 6, .near = 1.03 * slowest[2] / two_pi, .dense = dense}));
    std::vector<double> known = slowest;
    known.resize(6);
    check_rates(first_of(near, 3), first_of(known, 3), 1e-9);
  }
}

TEST_CASE("rods of a taut chain spin freely, and swing as a string of finite elements", "[linearised]") {
  // Consistent masses and straight elements: omega^2 = (6 T/(m l)) (1 - cos q)/(2 + cos q), q = j pi/N, in two planes.
  constexpr int rods = 4;
  constexpr double l = 0.35, m = 0.06, T = 12;
  for (const int dense : {0, 300}) {
    const ModesReport report = ModesOf(taut_chain(rods, l, m, T))({.count = 12, .dense = dense});
    CAPTURE(dense);
    CHECK(count_rigid(report) == rods);
    std::vector<double> exact;
    for (int j = 1; j < rods; ++j) {
      const double c = std::cos(j * std::numbers::pi / rods), rate = std::sqrt(6 * T / (m * l) * (1 - c) / (2 + c));
      exact.insert(exact.end(), {rate, rate});
    }
    check_rates(rates_of(report), exact, 1e-9);
    check_nothing_grows(report);
    if (dense > 0) CHECK(report.found.all);
  }
  // Under compression it is unstable in every plane, but the spins are not.
  const ModesReport pushed = ModesOf(taut_chain(rods, l, m, -T))({.count = 12});
  CHECK(count_rigid(pushed) == rods);
  CHECK(std::count_if(pushed.found.modes.begin(), pushed.found.modes.end(),
                      [](const Mode& mode) { return mode.kind == ModeKind::growing; }) == 2 * (rods - 1));
}

TEST_CASE("slow modes do not keep fast ones from being found, nor from being counted", "[linearised]") {
  const std::vector<double> exact = {1e-5, 3e-5, 20, 3e3};
  std::string nodes = "nodes:\n", elements = "elements:\n";
  for (std::size_t k = 0; k < exact.size(); ++k) {
    nodes += fmt::format("  m{}: {{position: [1, {}, 0], fixed: [y, z, rx, ry, rz]}}\n", k, k);
    elements += fmt::format("  m{0}: {{type: point_mass, node: m{0}, mass: 3}}\n", k);
    elements += fmt::format(
        "  s{0}: {{type: spring_damper, nodes: [ground, m{0}], at: [[0, {0}, 0], [0, 0, 0]], stiffness: {1}}}\n", k,
        3 * exact[k] * exact[k]);
  }
  const ModesReport report = ModesOf(nodes + elements)();
  CHECK(report.found.all);
  CHECK(count_rigid(report) == 0);
  check_rates(rates_of(report), exact, 1e-8);
}

TEST_CASE("what rounding of a stiffness hides is told from rigid motions only by what it is known to", "[linearised]") {
  // The sum of 1e12 and 1e-6 N/m is known to 1e-4: omega^2 = 1e-6/2 cannot be seen in it.
  const ModesReport report = ModesOf(
      "nodes: {a: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}, b: {position: [2, 0, 0], fixed: [y, z, rx, ry, "
      "rz]}}\n"
      "elements:\n  a: {type: point_mass, node: a, mass: 1}\n  b: {type: point_mass, node: b, mass: 1}\n"
      "  soft: {type: spring_damper, nodes: [ground, a], stiffness: 1e-6}\n"
      "  stiff: {type: spring_damper, nodes: [a, b], stiffness: 1e12}\n")();
  CHECK(count_rigid(report) == 1);
  CHECK(report.found.modes[0].uncertainty > std::sqrt(0.5e-6));
  CHECK(report.found.modes[0].uncertainty < 1);
  check_rates(rates_of(report), {std::sqrt(2e12)}, 1e-9);
  CHECK(report.found.modes[1].uncertainty < 1e-6 * std::sqrt(2e12));
}

TEST_CASE("growth is told however slow it is, where it is more than rounding", "[linearised]") {
  // A negative spring of -1e-6 N/m on 1 kg, alone and next to a stiff oscillator: s = 1e-3 1/s.
  for (const char* more : {"", "  t: {type: spring_damper, nodes: [ground, n], stiffness: 1e9}\n"}) {
    const ModesReport report = ModesOf(
        std::string(
            "nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}, n: {position: [1, 1, 0], fixed: [y, z, "
            "rx, ry, rz]}}\nelements:\n  m: {type: point_mass, node: m, mass: 1}\n  n: {type: point_mass, node: "
            "n, mass: 1}\n  s: {type: spring_damper, nodes: [ground, m], force: \"-1e-6*e\"}\n") +
        more)();
    long growing = 0;
    for (const Mode& mode : report.found.modes)
      if (mode.kind == ModeKind::growing) {
        ++growing;
        CHECK(mode.s.real() == Approx(1e-3).epsilon(1e-9));
      }
    CHECK(growing == 1);
  }
}

TEST_CASE("a free body that spins drifts and nutates; it grows about its middle axis alone", "[linearised]") {
  // Euler's equations: s^2 = -Om^2 (C - A)(C - B)/(A B) about the axis of C. In axes that turn with it, the frequency
  // of a body that drifts along equals the speed, twice, with one shape: no growth, and no critical speed.
  for (const auto& [A, B, C] : {std::tuple{0.2, 0.3, 0.4}, std::tuple{0.4, 0.3, 0.25}, std::tuple{0.2, 0.4, 0.3}}) {
    CAPTURE(A, B, C);
    const double square = (C - A) * (C - B) / (A * B);
    const auto file = read_mechanism_text(
        fmt::format(
            "nodes: {{b: {{position: [0, 0, 0]}}}}\nelements: {{b: {{type: rigid_body, node: b, mass: 3, inertia: "
            "[{}, {}, {}]}}}}\n"
            "analysis: [{{type: campbell, rotation: {{axis: [0, 0, 1]}}, speeds: {{from: 7, to: 90, count: 7}}, "
            "modes: 6, orders: [1]}}]\n",
            A, B, C),
        "model.yaml");
    Session session(file.model);
    ModesOptions options;
    options.rotation = SteadyRotation{{0, 0, 7}, {0, 0, 0}};
    const ModesReport report = compute_modes(session, options);
    double fastest = 0;
    for (const Mode& mode : report.found.modes)
      if (mode.kind == ModeKind::growing) fastest = std::max(fastest, mode.s.real());
    CHECK(fastest == Approx(square < 0 ? 7 * std::sqrt(-square) : 0).margin(1e-12));
    const AnalysisSummary summary = file.analyses.at(0)->run(session);
    CHECK(summary.numbers.count("critical_speed") == 0);
    CHECK_THAT(summary.text, !Catch::Contains("UNSTABLE"));
  }
}
