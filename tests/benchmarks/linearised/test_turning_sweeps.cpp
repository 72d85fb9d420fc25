// Rotors behind a joint over their speed and at rest, against closed forms.
#include <algorithm>
#include <cmath>

#include "mechanism/analyses/campbell.hpp"
#include "tests/benchmarks/linearised/turning_models.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_turning_sweeps {
namespace {

ModesReport modes_behind(const ModesOf& model, double rate, int count) {
  ModesOptions options;
  options.search.count = count;
  options.rotation = SteadyRotation{};
  options.rotation->joint = model.file.model.members_of({Section::joints, "shaft"}).front();
  options.rotation->rate = rate;
  return compute_modes(model.session, options);
}

std::string uniform_beam(const char* name, const char* from, const char* to, int elements) {
  return fmt::format(
      "  {}: {{type: beam, nodes: [{}, {}], elements: {}, orientation: [0, 1, 0], section: {{EA: 1e7, GAy: 1e7, GAz: "
      "1e7, GJ: 1, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 1e-7, Jy: 1e-7, Jz: 1e-7}}}}\n",
      name, from, to, elements);
}

}  // namespace

TEST_CASE("critical speeds of a disc behind a joint, on supports that differ, are those of its equations",
          "[linearised]") {
  // Jt a'' + Jp Om b' + k1 a = 0, Jt b'' - Jp Om a' + k2 b = 0 with s = i Om:
  // (k1 - Jt Om^2)(k2 - Jt Om^2) = (Jp Om^2)^2.
  constexpr double Jp = 0.01, Jt = 0.02, m = 5, k1 = 800, k2 = 500, kx = 2e5, ky = 1.2e5, kz = 3e5;
  const ModesOf model(disc_on_springs(m, "[0.02, 0.02, 0.01]", "[2e5, 1.2e5, 3e5, 800, 500, 500]"));
  CampbellOptions options;
  options.rotation = true;
  options.joint = "shaft";
  for (double value = 10; value < 305; value += 29) options.values.push_back(value);
  options.modes = 5;
  options.orders = {1};
  const Campbell found = compute_campbell(model.session, options);
  const double a = Jt * Jt - Jp * Jp, b = Jt * (k1 + k2), root = std::sqrt(b * b - 4 * a * k1 * k2);
  std::vector<double> expected = {std::sqrt((b - root) / (2 * a)), std::sqrt((b + root) / (2 * a)), std::sqrt(kx / m),
                                  std::sqrt(ky / m), std::sqrt(kz / m)};
  std::sort(expected.begin(), expected.end());
  std::vector<double> speeds;
  for (const CriticalSpeed& each : found.swept.critical) speeds.push_back(each.speed);
  check_rates(speeds, expected, 1e-8);
  REQUIRE(found.turning);
  CHECK(found.turning->periodicity == Periodicity::multiblade);
  CHECK(found.turning->change < 1e-7);
  REQUIRE(found.names.size() == 5);
  for (const std::string& name : found.names) {
    CHECK_THAT(name, Catch::Contains("disc "));
    CHECK(std::count(found.names.begin(), found.names.end(), name) == 1);
  }
}

TEST_CASE("at rest, and at a negligible rate, modes behind a joint are those of the mechanism as drawn",
          "[linearised]") {
  LagRotor rotor;
  rotor.blades = 2;
  rotor.k = 2e5;
  rotor.ky = 0.6 * rotor.kx;
  rotor.rate = 0;
  const ModesOf model(rotor.model());
  const std::vector<double> expected = rates_of(model());
  const double lowest = *std::min_element(expected.begin(), expected.end());
  for (const double share : {0.0, 1e-9, -1e-7}) {
    const ModesReport report = modes_behind(model, share * lowest, 20);
    CAPTURE(share);
    CHECK(report.turning->periodicity == Periodicity::negligible);
    check_rates(rates_of(report), expected, 1e-6);
  }
  // Copies of modes that differ by multiples of a slow rate can hardly be distinguished: the analysis reports this.
  CHECK_THAT(message_of<bielle::ComputationError>([&] { modes_behind(model, 1e-4 * lowest, 20); }),
             Catch::Contains("do not converge"));
}

TEST_CASE("a tower under a rotor at rest has the frequencies of a cantilever with a mass at its tip", "[linearised]") {
  // R. D. Blevins, Formulas for Natural Frequency and Mode Shape (1979), table 8-8: beam and mass at its tip, of
  // mass 1.
  const auto characteristic = [](double x) {
    return 1 + std::cos(x) * std::cosh(x) + x * (std::cos(x) * std::sinh(x) - std::sin(x) * std::cosh(x));
  };
  double low = 1, high = 1.5;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (characteristic(middle) > 0 ? low : high) = middle;
  }
  const ModesOf model(
      "nodes: {foot: {fixed: true}, top: {position: [0, 0, 1]}, rotor: {position: [0, 0, 1]}}\nelements:\n" +
      uniform_beam("tower", "foot", "top", 16) +
      "  rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [1e-6, 1e-6, 1e-6]}\n"
      "joints: {shaft: {type: hinge, nodes: [top, rotor], position: [0, 0, 1], axis: [1, 0, 0]}}\n");
  const std::vector<double> found = rates_of(modes_behind(model, 0, 2));
  check_rates(found, {low * low, low * low}, 1e-3);
}

TEST_CASE("the flap of four blades against each other has Southwell's frequency, on a standing part that moves",
          "[linearised]") {
  // The hub does not move: w^2 = w0^2 + 1.192 Om^2 for a uniform blade at Om = w0/3.5
  // (tests/references/rotating_beam.csv).
  const ReferenceTable exact("rotating_beam");
  constexpr int elements = 6;
  const auto w0 = rates_of("nodes: {root: {fixed: true}, tip: {position: [1, 0, 0]}}\nelements:\n" +
                           uniform_beam("blade", "root", "tip", elements));
  std::string text =
      "nodes: {nacelle: {}, hub: {}, t0: {position: [1, 0, 0]}, t1: {position: [0, 1, 0]}, t2: {position: [-1, 0, 0]}, "
      "t3: {position: [0, -1, 0]}}\nelements:\n"
      "  nacelle: {type: rigid_body, node: nacelle, mass: 1, inertia: [1, 1, 1]}\n"
      "  hub: {type: rigid_body, node: hub, mass: 1, inertia: [1, 1, 1]}\n";
  for (const char* tip : {"t0", "t1", "t2", "t3"}) {
    std::string blade = uniform_beam(fmt::format("b{}", tip[1]).c_str(), "hub", tip, elements);
    blade.replace(blade.find("[0, 1, 0]"), 9, "[0, 0, 1]");
    text += blade;
  }
  text +=
      "joints:\n  mount: {type: bushing, nodes: [ground, nacelle], stiffness: [40, 30, 50, 30, 40, 50]}\n"
      "  shaft: {type: hinge, nodes: [nacelle, hub], position: [0, 0, 0], axis: [0, 0, 1]}\n";
  const ModesReport report = modes_behind(ModesOf(text), 1, 14);
  CHECK(report.turning->periodicity == Periodicity::multiblade);
  const double southwell = std::pow(exact("1.flap_1"), 2) - std::pow(exact("0.flap_1"), 2);
  const double flap = std::sqrt(w0.at(0) * w0.at(0) + southwell);
  double nearest = INFINITY;
  for (const double rate : rates_of(report)) nearest = std::min(nearest, std::abs(rate - flap));
  CHECK(nearest < 1e-3 * flap);
}

TEST_CASE("a diagram of blades without `rotation` has no critical speeds", "[linearised]") {
  // The blades are not stretched by their centrifugal forces, so that the state is not a steady motion.
  const auto text = [](const char* speed) {
    return "parameters: {speed: 3}\nnodes: {hub: {}, tip: {position: [1, 0, 0]}}\nelements:\n"
           "  hub: {type: rigid_body, node: hub, mass: 1, inertia: [1, 1, 1]}\n" +
           uniform_beam("blade", "hub", "tip", 4) +
           fmt::format(
               "joints: {{shaft: {{type: hinge, nodes: [ground, hub], position: [0, 0, 0], axis: [0, 0, 1]}}}}\n"
               "drives: {{motor: {{joint: shaft, rate: {}}}}}\n",
               speed);
  };
  const ModesOf model(text("speed"));
  CampbellOptions options;
  options.parameter = "speed";
  options.maker = [&](const std::string& /*name*/, double value) {
    return read_mechanism_text(text(fmt::format("{:.17g}", value).c_str()), "model.yaml").model;
  };
  options.values = {0, 4, 8};
  options.modes = 2;
  options.orders = {1};
  const Campbell found = compute_campbell(model.session, options);
  CHECK_FALSE(found.unsteady.empty());
  CHECK(found.swept.critical.empty());
}

}  // namespace test_turning_sweeps
