// Frequency responses against closed forms and a vibration in time.
#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Complex = std::complex<double>;

namespace test_frequency_response {
namespace {

constexpr double m = 2, k = 200, c = 3;

const std::string oscillator =
    "inputs: {push: {start: 0, units: N}}\n"
    "nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
    "elements:\n  m: {type: point_mass, node: m, mass: 2}\n"
    "  s: {type: spring_damper, nodes: [ground, m], stiffness: 200, damping: 3}\n"
    "loads: {p: {node: m, force: [\"2*push\", 0, 0]}}\n"
    "measures: {place: m.position.x, speed: m.velocity.x, both: {formula: \"place + 0.1*push\", units: m}}\n";

/// Returns the oscillator with another force for its input.
std::string oscillator_pushed_by(const std::string& force) {
  const std::size_t at = oscillator.find("2*push");
  return oscillator.substr(0, at) + force + oscillator.substr(at + 6);
}

}  // namespace

TEST_CASE("an oscillator answers with 1/(k - m w^2 + i c w) to forces, twice that to an input that pushes twice",
          "[linearised]") {
  const ModesOf model(oscillator);
  const int node = *model.file.model.find_node("m");
  FrequencyResponseOptions options;
  options.inputs = {{"force", node, false, Vector3::UnitX()}, {"push", -1, false, Vector3::Zero()}};
  options.outputs = {{"displacement", node, false, Vector3::UnitX()},
                     {"place", -1, false, {}},
                     {"speed", -1, false, {}},
                     {"both", -1, false, {}}};
  options.frequencies = {0, 0.5, 1.5, 1.59, 10};
  const FrequencyResponse found = compute_frequency_response(model.session, options);
  for (std::size_t f = 0; f < options.frequencies.size(); ++f) {
    const double w = two_pi * options.frequencies[f];
    const Complex H = 1.0 / Complex(k - m * w * w, c * w), iw(0, w);
    const Eigen::MatrixXcd& found_here = found.response[f];
    CAPTURE(w);
    const auto check = [&](int i, int j, Complex exact) {
      CHECK(std::abs(found_here(i, j) - exact) <= 1e-9 * (std::abs(exact) + std::abs(H)));
    };
    check(0, 0, H);
    check(1, 0, H);
    check(2, 0, iw * H);
    check(3, 0, H);
    check(0, 1, 2.0 * H);
    check(1, 1, 2.0 * H);
    check(2, 1, 2.0 * iw * H);
    check(3, 1, 2.0 * H + 0.1);
  }
  CHECK(found.output_units == std::vector<std::string>{"m", "m", "m/s", "m"});
}

TEST_CASE("an oscillator with delayed forces answers with the factors exp(-i w T) of its delays", "[linearised]") {
  const double g = 80, d = 5, T = 0.03, T_d = 0.2;
  const ModesOf model(oscillator_pushed_by("2*push - 80*late - 5*later") +
                      "states: {late: {delayed: place, time: 0.03}, later: {delayed: speed, time: 0.2}}\n");
  FrequencyResponseOptions options;
  options.inputs = {{"force", *model.file.model.find_node("m"), false, Vector3::UnitX()},
                    {"push", -1, false, Vector3::Zero()}};
  options.outputs = {{"place", -1, false, {}}, {"late", -1, false, {}}, {"later", -1, false, {}}};
  options.frequencies = {0, 0.5, 1.5, 1.8, 10};
  const FrequencyResponse found = compute_frequency_response(model.session, options);
  for (std::size_t f = 0; f < options.frequencies.size(); ++f) {
    const double w = two_pi * options.frequencies[f];
    const Complex iw(0, w), late = std::exp(-iw * T), later = iw * std::exp(-iw * T_d),
                            H = 1.0 / (Complex(k - m * w * w, c * w) + g * late + d * later);
    CAPTURE(w);
    for (int input = 0; input < 2; ++input) {
      const Complex place = (input == 0 ? 1.0 : 2.0) * H;
      CHECK(std::abs(found.response[f](0, input) - place) < 1e-9 * std::abs(H));
      CHECK(std::abs(found.response[f](1, input) - late * place) < 1e-9 * std::abs(H));
      CHECK(std::abs(found.response[f](2, input) - later * place) < 1e-9 * (1 + w) * std::abs(H));
    }
  }
}

TEST_CASE("reactions, constraints and angles answer too", "[linearised]") {
  // Small motions of a pendulum that is pushed at its bob: angle H = l/(J (w0^2 - w^2)); its pivot carries the
  // remaining force.
  const ModesOf model(
      "gravity: [0, 0, -9.81]\nnodes: {bob: {position: [0, 0, -2]}}\n"
      "elements: {bob: {type: rigid_body, node: bob, mass: 3, inertia: [0.5, 0.5, 0.5]}}\n"
      "joints: {pivot: {type: hinge, nodes: [ground, bob], position: [0, 0, 0], axis: [0, 1, 0], second_axis: [1, 0, "
      "0]}}\n"
      "measures: {swing: pivot.angle, bears: pivot.reaction.x}\n");
  FrequencyResponseOptions options;
  const int node = *model.file.model.find_node("bob");
  options.inputs = {{"force", node, false, Vector3::UnitX()}, {"moment", node, true, Vector3::UnitY()}};
  options.outputs = {{"swing", -1, false, {}}, {"turn", node, true, Vector3::UnitY()}, {"bears", -1, false, {}}};
  options.frequencies = {0, 0.2, 2};
  const FrequencyResponse found = compute_frequency_response(model.session, options);
  const double J = 0.5 + 3 * 4, w0 = std::sqrt(3 * 9.81 * 2 / J);
  for (std::size_t f = 0; f < options.frequencies.size(); ++f) {
    const double w = two_pi * options.frequencies[f], H = 1 / (J * (w0 * w0 - w * w));
    // The bob is below the pivot: a force along x has the moment -2 about +y.
    CHECK(std::abs(found.response[f](0, 0) - -2 * H) < 1e-10 * std::abs(H));
    CHECK(std::abs(found.response[f](0, 1) - H) < 1e-10 * std::abs(H));
    CHECK(std::abs(found.response[f](1, 1) - H) < 1e-10 * std::abs(H));
    // The bob is at x = -2 swing: m x'' = F + R.
    CHECK(std::abs(found.response[f](2, 0) - (-3 * w * w * 4 * H - 1)) < 1e-9);
    CHECK(std::abs(found.response[f](2, 1) - (-3 * w * w * -2 * H)) < 1e-9);
  }
}

TEST_CASE("a vibration in time settles to the frequency response", "[linearised]") {
  // A small force drives the same oscillator at 1.3 Hz in time; its motion over the last period is compared with |H|.
  const double w = two_pi * 1.3;
  std::string text = oscillator;
  text.replace(text.find("\"2*push\""), 8, "\"1e-3*cos(2*pi*1.3*t)\"");
  ModesOf driven(text);
  DynamicsOptions options;
  options.duration = 30 / 1.3;
  options.stepping.size = options.duration / 30 / 2000;
  options.scheme = Scheme::generalized_alpha(1);
  double most = 0;
  driven.session.on_step([&](Session& at) {
    if (at.time() > 29 / 1.3) most = std::max(most, std::abs(at.read("measures/place")[0] - 1));
  });
  driven.session.dynamics(options).finish();
  CHECK(most == Approx(1e-3 / std::abs(Complex(k - m * w * w, c * w))).epsilon(1e-4));
}

TEST_CASE("the analysis `frequency_response` records what it finds", "[linearised]") {
  const MechanismFile file =
      read_mechanism_text(oscillator +
                              "analysis: [{type: frequency_response, inputs: [push, {node: m, direction: x}], outputs: "
                              "[place, {node: m, direction: x, quantity: "
                              "displacement}], frequencies: {from: 0.5, to: 5, count: 11}}]\n",
                          "model.yaml");
  Session session(file.model);
  MemorySink sink(file.model);
  session.add_sink(sink);
  const AnalysisSummary summary = file.analyses[0]->run(session);
  CHECK(summary.numbers.at("peak").size() == 4);
  const std::vector<double> frequency = sink.read(0, "frequency_response/frequency"),
                            response = sink.read(0, "frequency_response/response");
  REQUIRE(frequency.size() == 11);
  REQUIRE(response.size() == 11 * 2 * 2 * 2);
  CHECK(frequency[5] == Approx(std::sqrt(0.5 * 5)));
  const double w = two_pi * frequency[5];
  const Complex H = 1.0 / Complex(k - m * w * w, c * w);
  const auto at = [&](std::size_t output, std::size_t input) {
    const std::size_t place = 2 * (input + 2 * (output + 2 * 5));
    return Complex(response[place], response[place + 1]);
  };
  CHECK(std::abs(at(0, 0) - 2.0 * H) < 1e-9 * std::abs(H));
  CHECK(std::abs(at(1, 1) - H) < 1e-9 * std::abs(H));
  CHECK_THAT(summary.text, Catch::Contains("place [m] per unit of push"));
}

TEST_CASE("a frequency at which the mechanism moves by itself has no response", "[linearised]") {
  const ModesOf free(
      "nodes: {m: {position: [0, 0, 0]}}\nelements: {m: {type: rigid_body, node: m, mass: 1, inertia: [1, 1, 1]}}\n");
  FrequencyResponseOptions options;
  options.inputs = {{"force", *free.file.model.find_node("m"), false, Vector3::UnitX()}};
  options.outputs = {{"moves", *free.file.model.find_node("m"), false, Vector3::UnitX()}};
  options.frequencies = {0};
  CHECK_THROWS_WITH(compute_frequency_response(free.session, options), Catch::Contains("no response at 0 Hz"));
  options.outputs[0] = {"speeed", -1, false, {}};
  CHECK_THROWS_WITH(compute_frequency_response(free.session, options), Catch::Contains("there is no measure 'speeed'"));
}

TEST_CASE("inputs that act on nothing are refused, and the summary says what the state is", "[linearised]") {
  const ModesOf model(oscillator);
  const int node = *model.file.model.find_node("m");
  FrequencyResponseOptions options{{{"force y", node, false, Vector3::UnitY()}}, {{"place", -1, false, {}}}, {1}, {}};
  CHECK_THROWS_WITH(compute_frequency_response(model.session, options),
                    Catch::Contains("'force y' acts on nothing: the node is held in that direction"));
  const ModesOf without(oscillator_pushed_by("0"));
  options.inputs = {{"push", -1, false, Vector3::Zero()}};
  CHECK_THROWS_WITH(compute_frequency_response(without.session, options),
                    Catch::Contains("no force, motion or output depends"));
  options.outputs = {{"both", -1, false, {}}};  // the outputs contain the input itself
  CHECK(std::abs(compute_frequency_response(without.session, options).response[0](0, 0) - 0.1) < 1e-12);

  const MechanismFile file = read_mechanism_text(
      oscillator_pushed_by("7 + 2*push") +
          "analysis: [{type: frequency_response, inputs: [push], outputs: [place], frequencies: [1]}]\n",
      "model.yaml");
  Session session(file.model);
  CHECK_THAT(file.analyses[0]->run(session).text,
             Catch::Contains("not in equilibrium") && Catch::Contains("responses are those of the equations"));
}

}  // namespace test_frequency_response
