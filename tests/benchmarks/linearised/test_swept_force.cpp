// Frequency responses against a motion in time under a force whose frequency rises slowly.
#include <cmath>

#include "mechanism/analyses/frequency_response.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Complex = std::complex<double>;

namespace {

constexpr double first = 2, last = 9, duration = 120;  // [Hz], [s]

/// Returns a pendulum below a block on a spring: constraints, gravity, two resonances. Small motions.
std::string crane(const std::string& force) {
  return "gravity: [0, 0, -9.81]\n"
         "nodes:\n  block: {position: [0, 0, 0], fixed: [y, z, rx, ry, rz]}\n  bob: {position: [0, 0, -0.1]}\n"
         "elements:\n  block: {type: rigid_body, node: block, mass: 2, inertia: [1, 1, 1]}\n"
         "  bob: {type: rigid_body, node: bob, mass: 0.7, inertia: [1e-3, 1e-3, 1e-3]}\n"
         "joints: {pivot: {type: hinge, nodes: [block, bob], position: [0, 0, 0], axis: [0, 1, 0], second_axis: [1, 0, "
         "0], damping: 3e-3}}\n"
         "loads: {push: {node: block, force: [\"" +
         force + " - 2000*place - 20*speed\", 0, 0]}}\n" +
         "measures: {place: block.position.x, speed: block.velocity.x, swing: pivot.angle}\n";
}

}  // namespace

TEST_CASE("a slowly swept force moves a mechanism as its frequency response says, all along", "[linearised]") {
  const double rate = two_pi * (last - first) / duration;  // [rad/s^2]
  constexpr double size = 1e-2;
  ModesOf moving(crane(fmt::format("{}*sin(2*pi*{}*t + {}*t^2)", size, first, rate / 2)));
  DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = 1e-3;
  options.scheme = Scheme::generalized_alpha(1);
  // Amplitudes over whole periods: x = Im(a exp(i phi)), by sums over one period of the force.
  struct Window {
    double begin = 0, phase = 0;
    Complex sums[2] = {};
    double time = 0;
  } window;
  std::vector<double> frequencies;
  std::vector<Complex> amplitudes[2];
  double last_time = 0;
  moving.session.on_step([&](Session& at) {
    const double t = at.time(), phase = two_pi * first * t + 0.5 * rate * t * t, step = t - last_time;
    last_time = t;
    const Complex turned = Complex(0, 1) * std::polar(1.0, -phase);
    window.sums[0] += step * at.measure("place") * turned;
    window.sums[1] += step * at.measure("swing") * turned;
    window.time += step;
    if (phase - window.phase < 2 * two_pi) return;
    frequencies.push_back(first + rate * (t - 0.5 * window.time) / two_pi);
    for (int k = 0; k < 2; ++k) amplitudes[k].push_back(2.0 * window.sums[k] / window.time / size);
    window = {t, phase, {}, 0};
  });
  moving.session.dynamics(options).finish();

  const ModesOf still(crane("0"));
  FrequencyResponseOptions asked;
  asked.inputs = {{"force", *still.file.model.find_node("block"), false, Vector3::UnitX()}};
  asked.outputs = {{"place", -1, false, {}}, {"swing", -1, false, {}}};
  asked.frequencies = frequencies;
  const FrequencyResponse exact = compute_frequency_response(still.session, asked);
  double largest[2] = {}, worst[2] = {};
  for (std::size_t f = 0; f < frequencies.size(); ++f)
    for (int k = 0; k < 2; ++k) largest[k] = std::max(largest[k], std::abs(exact.response[f](k, 0)));
  for (std::size_t f = 8; f < frequencies.size(); ++f)
    for (int k = 0; k < 2; ++k)
      worst[k] = std::max(worst[k], std::abs(amplitudes[k][f] - exact.response[f](k, 0)) / largest[k]);
  CAPTURE(worst[0], worst[1], frequencies.size());
  // A sweep at the rate r lags by r/(2 (zeta w)^2) of a resonance: 2 % here.
  CHECK(worst[0] < 0.03);
  CHECK(worst[1] < 0.03);
}
