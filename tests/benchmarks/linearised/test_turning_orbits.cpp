// Small motions about periodic motions of rotors under gravity and out of balance (tests/references/turning_orbits.py).
#include <algorithm>
#include <initializer_list>
#include <optional>

#include "mechanism/analyses/campbell.hpp"
#include "mechanism/solvers/linearised/periodic_orbit.hpp"
#include "tests/benchmarks/linearised/gravity_models.hpp"
#include "tests/benchmarks/linearised/turning_models.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_turning_orbits {
namespace {

using Complex = std::complex<double>;

struct Turning {
  ModesOf model;
  ModesReport report;
  Turning(const std::string& text, double rate, bool mean = false, int harmonics = 1)
      : model(text), report(compute_modes(model.session, options(model, rate, mean, harmonics))) {}
  static ModesOptions options(const ModesOf& model, double rate, bool mean, int harmonics) {
    ModesOptions options;
    SteadyRotation rotation;
    rotation.joint = model.file.model.members_of({Section::joints, "shaft"}).front();
    rotation.rate = rate;
    rotation.mean = mean;
    options.rotation = rotation;
    options.harmonics = harmonics;
    return options;
  }
  std::vector<Complex> exponents() const {
    std::vector<Complex> list;
    for (const Mode& mode : report.found.modes)
      if (mode.kind != ModeKind::rigid) list.push_back(mode.s);
    return list;
  }
  /// Returns the periodic motion.
  PeriodicOrbit orbit() const {
    const StandingState& about = report.about;
    const System& system = model.session.system();
    const TurningPart part(system, about.environment, about.state,
                           model.file.model.members_of({Section::joints, "shaft"}).front());
    const auto found = find_periodic_orbit(system, about.environment, about.state, part, report.turning->rate);
    REQUIRE(found);
    return *found;
  }
  int first_unknown(const char* node) const {
    return model.session.system().kinematics().freedom(*model.file.model.find_node(node)).begin;
  }
};

/// Returns the distance of an exponent, or its conjugate, from another one modulo i rate.
double distance(Complex s, Complex exact, double rate) {
  const auto apart = [&](Complex a) { return Complex(a.real(), std::remainder(a.imag(), rate)); };
  return std::min(std::abs(apart(s - exact)), std::abs(apart(std::conj(s) - exact)));
}

/// Checks that the exponents are those of the table, each once.
void check_table(const std::vector<Complex>& found, const ReferenceTable& table, const std::string& name, double rate,
                 double within) {
  std::vector<Complex> left = found;
  for (std::size_t k = 1; k <= found.size(); ++k) {
    const Complex exact(table(fmt::format("{}.real_{}", name, k)), table(fmt::format("{}.imaginary_{}", name, k)));
    CAPTURE(name, k, exact);
    REQUIRE_FALSE(left.empty());
    const auto nearest = std::min_element(left.begin(), left.end(), [&](Complex a, Complex b) {
      return distance(a, exact, rate) < distance(b, exact, rate);
    });
    CHECK(distance(*nearest, exact, rate) < within);
    left.erase(nearest);
  }
}

/// Checks that each mode of a slow rotor is next to one of its mean state. @returns the exponents
std::vector<Complex> check_next_to_mean(double rate) {
  // Gravity changes the frequency of a blade, 12.6 rad/s, by up to 0.8 rad/s over a turn, which exceeds the lower
  // rates.
  CAPTURE(rate);
  const std::string text = blades(3, 60, springs, fmt::format("rate: {}", rate));
  const Turning turning(text, rate), mean(text, rate, true);
  CHECK(count_rigid(turning.report) == 1);
  const std::vector<Complex> found = turning.exponents();
  std::vector<Complex> of_mean = mean.exponents();
  REQUIRE(found.size() == 5);
  REQUIRE(of_mean.size() == 5);
  CHECK(turning.report.turning->unresolved == 0);
  // The exponent that represents a motion is not one of its copies, which differ by multiples of the rate.
  for (const Complex s : found) {
    const auto nearest = std::min_element(of_mean.begin(), of_mean.end(),
                                          [&](Complex a, Complex b) { return std::abs(a - s) < std::abs(b - s); });
    CAPTURE(s);
    CHECK(std::abs(*nearest - s) < std::abs(rate));
    of_mean.erase(nearest);
  }
  return found;
}

/// Checks the exponents of strongly damped blades in parametric resonance: two for each, which add up to the damping.
void check_resonance(std::initializer_list<int> counts) {
  constexpr double inertia = 0.38;
  struct Case {
    double rate, damping;
    int turns;  ///< frequency in multiples of half the rate
  };
  for (const Case& each : {Case{2, 9.58, 0}, Case{3, 9.3, 0}, Case{6, 10, 1}, Case{6, 9.6, 1}})
    for (const int count : counts) {
      CAPTURE(each.rate, each.damping, count);
      const std::string text = blades(count, 60, std::nullopt, fmt::format("rate: {}", each.rate), each.damping);
      const Turning turning(text, each.rate);
      CHECK(turning.report.found.all);
      const std::vector<Complex> found = turning.exponents();
      REQUIRE(found.size() == 2 * static_cast<std::size_t>(count));
      for (std::size_t k = 0; k < found.size(); ++k) {
        CHECK(found[k].imag() == Approx(each.turns * each.rate / 2));
        const Complex other = found[found.size() - 1 - k];
        CHECK(found[k].real() + other.real() == Approx(-each.damping / inertia).epsilon(1e-6));
        CHECK(std::abs(found[k].real() - other.real()) > 0.1);
      }
    }
}

}  // namespace

TEST_CASE("blades under gravity have the Floquet exponents of their nonlinear equations", "[linearised]") {
  const ReferenceTable table("turning_orbits");
  struct Case {
    const char* name;
    std::string text;
    std::size_t modes;
  };
  const Case cases[] = {{"blade", blades(1, 60, std::nullopt), 1},
                        {"soft_blade", blades(1, 20, std::nullopt), 1},
                        {"two_blades", blades(2, 60, springs), 4}};
  for (const Case& each : cases) {
    const Turning turning(each.text, 6);
    CAPTURE(each.name);
    CHECK(turning.report.turning->periodicity == Periodicity::periodic);
    CHECK(count_rigid(turning.report) == 1);  // the drive prescribes the rate, not the angle
    REQUIRE(turning.exponents().size() == each.modes);
    check_table(turning.exponents(), table, each.name, 6, 3e-6);  // 1e-7 of the largest exponent
  }
}

TEST_CASE("slow rotors under gravity have the modes of their nonlinear equations, next to those of the mean state",
          "[linearised]") {
  const ReferenceTable table("turning_orbits");
  check_table(check_next_to_mean(1), table, "slow_blades", 1, 3e-6);
}

TEST_CASE("slower rotors under gravity have modes next to those of the mean state, in either sense",
          "[linearised][long]") {
  for (const double rate : {0.3, -0.3}) check_next_to_mean(rate);
}

TEST_CASE("slow blades have the exponents that a search around a frequency finds among all copies", "[linearised]") {
  // The search does not use the mean state, and takes the copy with the largest harmonic.
  const double rate = 0.3;
  const Turning turning(blades(3, 60, springs, "rate: 0.3"), rate);
  CHECK(turning.report.turning->harmonics > 8);
  ModesOptions near = Turning::options(turning.model, rate, false, 1);
  near.search.near = 2;
  near.search.count = 3;
  std::vector<Complex> left = turning.exponents();
  for (const Mode& mode : compute_modes(turning.model.session, near).found.modes) {
    const auto nearest = std::min_element(left.begin(), left.end(), [&](Complex a, Complex b) {
      return distance(a, mode.s, rate) < distance(b, mode.s, rate);
    });
    CHECK(distance(*nearest, mode.s, rate) < 1e-5);
    left.erase(nearest);
  }
  CHECK(left.size() == 2);
}

TEST_CASE("blades without coupling have one exponent, and three independent shapes", "[linearised]") {
  const double rate = 0.3;
  const Turning turning(blades(3, 60, std::nullopt, "rate: 0.3"), rate);
  const std::vector<HarmonicMode>& modes = turning.report.harmonic->modes;
  std::vector<Eigen::VectorXcd> shapes;
  for (const HarmonicMode& each : modes)
    if (std::abs(each.mode.s - modes.back().mode.s) < 1e-6) shapes.emplace_back(each.u.reshaped().normalized());
  REQUIRE(shapes.size() == 3);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < k; ++j) CHECK(std::abs(shapes[j].dot(shapes[k])) < 0.5);
}

TEST_CASE("overdamped blades without coupling have as many slow decays as blades, and as many fast ones",
          "[linearised]") {
  // The exponents of a blade (0.38 kg m^2 about its hinge) add up to -c/J by Liouville's formula.
  constexpr double damping = 19.1, inertia = 0.38;
  for (const int count : {2, 3, 4, 5}) {
    CAPTURE(count);
    const Turning turning(blades(count, 60, std::nullopt, "rate: 6", damping), 6);
    CHECK(count_rigid(turning.report) == 1);
    CHECK(turning.report.found.all);
    const std::vector<Complex> found = turning.exponents();
    REQUIRE(found.size() == 2 * static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < found.size(); ++k) {
      CHECK(found[k].imag() == 0);
      const Complex other = found[found.size() - 1 - k];
      CHECK(found[k].real() + other.real() == Approx(-damping / inertia).epsilon(1e-6));
    }
  }
}

TEST_CASE("strongly damped blades have two exponents each in parametric resonance, which add up to the damping",
          "[linearised]") {
  check_resonance({1, 2});
}

TEST_CASE("more strongly damped blades in parametric resonance have two exponents each", "[linearised][long]") {
  check_resonance({3, 4});
}

TEST_CASE("a blade that is overdamped about its mean state may oscillate about its periodic motion", "[linearised]") {
  // Exponents -13.289 +- 2.304 i by an integration of the equation over a turn, which adds up to -c/J.
  const Turning turning(blades(1, 60, std::nullopt, "rate: 6", 10.1), 6);
  const std::vector<Complex> found = turning.exponents();
  REQUIRE(found.size() == 1);
  CHECK(found[0].real() == Approx(-10.1 / 0.38 / 2).epsilon(1e-6));
  CHECK(std::abs(std::remainder(found[0].imag(), 6)) == Approx(2.304).margin(1e-3));
}

TEST_CASE("an oscillation that has half the rate as its frequency by chance is one mode", "[linearised]") {
  // sqrt(k/m - (c/2m)^2) = 3 rad/s
  std::string text = blades(3, 60, std::nullopt);
  const auto add = [&](const std::string& section, const std::string& entry) {
    text.insert(text.find(section) + section.size(), entry);
  };
  add("nodes:\n", "  box: {fixed: [y, z, rx, ry, rz]}\n");
  add("elements:\n", "  box: {type: point_mass, node: box, mass: 1}\n");
  add("joints:\n",
      "  tie: {type: bushing, nodes: [ground, box], stiffness: [9.25, 0, 0, 0, 0, 0], damping: [1, 0, 0, 0, 0, 0]}\n");
  const Turning turning(text, 6);
  CHECK(turning.report.found.all);
  const std::vector<Complex> found = turning.exponents();
  REQUIRE(found.size() == 4);
  CHECK(found[0].real() == Approx(-0.5));
  CHECK(found[0].imag() == Approx(3));
}

TEST_CASE("overdamped unequal blades have all modes, of which copies hide some about the mean state",
          "[linearised][long]") {
  const Turning turning(blades(3, 60, springs, "rate: 0.3", 19.1, 1.1), 0.3);
  CHECK(turning.report.found.all);
  CHECK(turning.exponents().size() == 8);
}

TEST_CASE("blades in parametric resonance have two exponents each, which are locked to the rotation", "[linearised]") {
  const ReferenceTable table("turning_orbits");
  const double decays = table("resonant_blade.real_1"), grows = table("resonant_blade.real_2");
  for (const double rate : {25.13, -25.13})
    for (const int count : {1, 2, 3}) {
      CAPTURE(rate, count);
      const Turning turning(blades(count, 60, std::nullopt, fmt::format("rate: {}", rate), 0.01, 1, 0), rate);
      CHECK(turning.report.found.all);
      std::vector<Eigen::VectorXcd> growing, decaying;
      for (const Mode& mode : turning.report.found.modes) {
        if (mode.kind == ModeKind::rigid) continue;
        CHECK(std::abs(mode.s.imag()) == Approx(std::abs(rate) / 2));
        CHECK(mode.s.real() == Approx(mode.s.real() > 0 ? grows : decays).epsilon(1e-5));
        Eigen::VectorXcd state(mode.u.size() + mode.w.size());  // a motion may pass through zero at the azimuth 0
        state << mode.u, mode.w / mode.s;
        (mode.s.real() > 0 ? growing : decaying).push_back(state.normalized());
      }
      for (const auto& shapes : {growing, decaying}) {
        REQUIRE(shapes.size() == static_cast<std::size_t>(count));
        Eigen::MatrixXcd columns(shapes.front().size(), count);
        for (int k = 0; k < count; ++k) columns.col(k) = shapes[static_cast<std::size_t>(k)];
        const auto lengths = Eigen::JacobiSVD<Eigen::MatrixXcd>(columns).singularValues();
        CHECK(lengths[count - 1] > 0.1 * lengths[0]);  // independent
      }
    }
}

TEST_CASE("modes of slow unequal blades are those next to the modes of their mean state, the slowest first",
          "[linearised]") {
  for (const double rate : {0.31, 0.3}) {
    CAPTURE(rate);
    const std::string text = blades(3, 60, springs, fmt::format("rate: {}", rate), 0.3, 1.1);
    const Turning turning(text, rate), mean(text, rate, true);
    CHECK(turning.report.turning->unresolved == 0);
    const std::vector<Complex> found = turning.exponents();
    std::vector<Complex> of_mean = mean.exponents();
    REQUIRE(found.size() == 5);
    REQUIRE(of_mean.size() == 5);
    CHECK(std::is_sorted(found.begin(), found.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); }));
    for (const Complex s : found) {
      const auto nearest = std::min_element(of_mean.begin(), of_mean.end(),
                                            [&](Complex a, Complex b) { return std::abs(a - s) < std::abs(b - s); });
      CAPTURE(s);
      CHECK(std::abs(*nearest - s) < std::abs(rate));
      of_mean.erase(nearest);
    }
  }
}

TEST_CASE("a rotor too slow for harmonics has the modes of its mean state", "[linearised][long]") {
  const double rate = 0.01;
  const std::string text = blades(3, 60, springs, fmt::format("rate: {}", rate));
  const Turning turning(text, rate), mean(text, rate, true);
  CHECK(turning.report.turning->unresolved > 0);
  CHECK(turning.report.turning->orbit_harmonics > 0);
  CHECK(mean.report.turning->unresolved == 0);
  CHECK(count_rigid(turning.report) == 1);
  const std::vector<Complex> found = turning.exponents(), expected = mean.exponents();
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) CHECK(std::abs(found[k] - expected[k]) < 1e-9);
}

TEST_CASE("modes of a slow rotor under gravity are followed from rest, and through it", "[linearised]") {
  const ModesOf model(blades(3, 60, springs, "rate: 1"));
  CampbellOptions options;
  options.rotation = true;
  options.joint = "shaft";
  options.values = {-1, 1};
  options.modes = 5;
  const Campbell found = compute_campbell(model.session, options);
  const std::vector<SweepPoint>& points = found.swept.points;
  REQUIRE(points.size() == 3);
  CHECK(points[1].speed == 0);
  CHECK(found.swept.uncertain.empty());
  for (const SweepPoint& point : points)
    for (const TrackedMode& track : point.tracks) CHECK(track.found);
  std::vector<double> backwards, forwards;
  for (std::size_t k = 0; k < points[0].tracks.size(); ++k) {
    backwards.push_back(points[0].tracks[k].s.imag());
    forwards.push_back(points[2].tracks[k].s.imag());
  }
  std::sort(backwards.begin(), backwards.end());
  std::sort(forwards.begin(), forwards.end());
  for (std::size_t k = 0; k < forwards.size(); ++k) CHECK(backwards[k] == Approx(forwards[k]).epsilon(1e-6));
}

TEST_CASE("a driven shaft has one free angle however far a blade behind it swings", "[linearised]") {
  // The exponents of the blade (2.1 kg m^2 about its hinge, damping 0.5) add up to -0.5/2.1 by Liouville's formula.
  for (const double rate : {6.0, 6.1, 7.0}) {
    CAPTURE(rate);
    const Turning turning(fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{hub: {{}}, b: {{position: [1.3, 0, 0]}}}}
elements:
  hub: {{type: rigid_body, node: hub, mass: 1, inertia: [1, 1, 1]}}
  b: {{type: rigid_body, node: b, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints:
  shaft: {{type: hinge, nodes: [ground, hub], axis: [0, -1, 0]}}
  lag: {{type: hinge, nodes: [hub, b], position: [0.3, 0, 0], axis: [0, -1, 0], stiffness: 20, damping: 0.5}}
drives: {{turn: {{joint: shaft, rate: {}}}}}
)yaml",
                                      rate),
                          rate);
    CHECK(count_rigid(turning.report) == 1);
    REQUIRE(turning.exponents().size() == 1);
    CHECK(turning.exponents()[0].real() == Approx(-0.25 / 2.1).epsilon(1e-6));
  }
}

TEST_CASE("more harmonics of the rotation than a blade under gravity needs change nothing", "[linearised]") {
  const ReferenceTable table("turning_orbits");
  const Turning turning(blades(1, 60, std::nullopt), 6, false, 6);
  REQUIRE(turning.exponents().size() == 1);
  check_table(turning.exponents(), table, "blade", 6, 2e-8);
}

TEST_CASE("blades swing under gravity as their nonlinear equations say", "[linearised]") {
  const ReferenceTable table("turning_orbits");
  for (const char* name : {"blade", "soft_blade"}) {
    const Turning turning(blades(1, std::string(name) == "blade" ? 60 : 20, std::nullopt, "angle: 6*t"), 6);
    CAPTURE(name);
    CHECK(count_rigid(turning.report) == 0);
    REQUIRE(turning.exponents().size() == 1);
    check_table(turning.exponents(), table, name, 6, 3e-6);
    const PeriodicOrbit orbit = turning.orbit();
    const VectorX q = orbit.deviation.at(0), v = orbit.deviation.rate_at(0);
    const int rotation = turning.first_unknown("b0") + 3;
    CHECK(q[rotation] == Approx(table(std::string(name) + ".start_1")).margin(1e-7));
    CHECK(v[rotation] == Approx(table(std::string(name) + ".rate_1")).margin(1e-6));
    CHECK(orbit.displacement > 0.4 * std::abs(q[rotation]) * 0.9);
  }
}

TEST_CASE("an unbalanced rotor that turns freely below its critical speed does not grow", "[linearised]") {
  const ReferenceTable table("turning_orbits");
  const Turning turning(unbalanced(), 7);
  CHECK(count_rigid(turning.report) == 1);
  REQUIRE(turning.exponents().size() == 2);
  for (int k = 1; k <= 2; ++k) {
    const Complex exact(0, table(fmt::format("unbalance.imaginary_{}", k)));
    const std::vector<Complex> found = turning.exponents();
    CHECK(std::min(distance(found[0], exact, 7), distance(found[1], exact, 7)) < 1e-8);
  }
  for (const Mode& mode : turning.report.found.modes) CHECK(mode.kind != ModeKind::growing);
}

TEST_CASE("the mean state of a rotor out of balance has no vibration", "[linearised]") {
  const Turning turning(unbalanced(), 7), mean(unbalanced(), 7, true);
  CHECK(mean.report.turning->mean);
  CHECK(mean.report.turning->orbit_harmonics == 0);
  CHECK(turning.report.turning->orbit_harmonics > 0);
  CHECK(turning.report.turning->displacement == Approx(24.5 / (1000 - 11 * 49)).epsilon(0.05));
  // The reaction of the hub, which keeps the rotor at its rate, is missing, so that exponents are wrong by more than
  // rounding.
  const ReferenceTable table("turning_orbits");
  const Complex exact(0, table("unbalance.imaginary_1"));
  for (const Complex s : mean.exponents()) CHECK(distance(s, exact, 7) > 1e-3);
}

TEST_CASE("a driven unbalanced rotor deflects its hub by m e Om^2/(k - M Om^2), and turns at any phase",
          "[linearised]") {
  const Turning turning(unbalanced("", "rate: 7"), 7);
  CHECK(count_rigid(turning.report) == 1);
  const std::vector<Complex> found = turning.exponents();
  REQUIRE(found.size() == 2);
  // At a given rate the equations of the hub are linear.
  CHECK(found[0].imag() == Approx(std::sqrt(1000.0 / 11)).epsilon(1e-9));
  CHECK(found[1].imag() == Approx(std::sqrt(1500.0 / 11)).epsilon(1e-9));
  const PeriodicOrbit orbit = turning.orbit();
  const int hub = turning.first_unknown("hub");
  constexpr double force = 1 * 0.5 * 49;
  CHECK(orbit.deviation.sizes(hub)[1] == Approx(force / (1000 - 11 * 49)).epsilon(1e-9));
  CHECK(orbit.deviation.sizes(hub + 1)[1] == Approx(force / (1500 - 11 * 49)).epsilon(1e-9));
}

TEST_CASE("a pendulum that turns over keeps its energy", "[linearised]") {
  constexpr double rate = 9, g = 9.81, r = 0.5, inertia = 0.26;
  const Turning turning(
      "gravity: [0, -9.81, 0]\nnodes: {p: {position: [0.5, 0, 0]}}\n"
      "elements: {p: {type: rigid_body, node: p, mass: 1, inertia: [0.01, 0.01, 0.01]}}\n"
      "joints: {shaft: {type: hinge, nodes: [ground, p], position: [0, 0, 0], axis: [0, 0, 1]}}\n",
      rate);
  CHECK(count_rigid(turning.report) == 1);
  CHECK(turning.exponents().empty());
  const PeriodicOrbit orbit = turning.orbit();
  const int rotation = turning.first_unknown("p") + 5;
  const auto energy = [&](double psi) {
    const double omega = rate + orbit.deviation.rate_at(psi)[rotation];
    return 0.5 * inertia * omega * omega + g * r * std::sin(psi + orbit.deviation.at(psi)[rotation]);
  };
  for (const double psi : {1.0, 2.0, 4.0, 5.5}) CHECK(energy(psi) == Approx(energy(0)).epsilon(1e-9));
  CHECK(orbit.deviation.rate_at(0.25 * two_pi)[rotation] < -1);  // slow at the top
}

TEST_CASE("a damped rotor without a periodic motion near its mean state is refused", "[linearised][long]") {
  CHECK_THROWS_WITH(Turning(unbalanced(", damping: [20, 20, 0, 0, 0, 0]"), 7),
                    Catch::Contains("no periodic motion at 7 rad/s") && Catch::Contains("a drive with a `rate`"));
}

TEST_CASE("a blade that the slow rotation alone centres has no periodic motion, as it tumbles", "[linearised]") {
  CHECK_THROWS_WITH(Turning(blades(1, 0, std::nullopt, "rate: 0.5"), 0.5), Catch::Contains("no periodic motion"));
}

TEST_CASE("a balanced rotor without gravity across its axis has no vibration", "[linearised]") {
  LagRotor rotor;
  const Turning turning(rotor.model(), rotor.rate);
  CHECK(turning.report.turning->orbit_harmonics == 0);
  CHECK(turning.report.turning->displacement == 0);
}

}  // namespace test_turning_orbits
