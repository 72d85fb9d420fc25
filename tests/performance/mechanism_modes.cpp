// The cost of modes of large models: hanging chains of elastic links, with hinges about two alternating axes.
//
//   performance_mechanism_modes [LINKS] [MODES]
//
// The slowest frequencies are those of a heavy chain, j_n sqrt(g/L)/2 with the zeros j_n of Bessel's J0, except for the
// effect of its links and their stiffness.
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/performance/processor_time.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::performance::processor_seconds;

namespace {

std::string hanging_chain(int links) {
  std::string nodes, elements, joints;
  for (int k = 0; k < links; ++k) {
    nodes += fmt::format("  a{0}: {{position: [0, 0, {1}]}}\n  b{0}: {{position: [0, 0, {2}]}}\n", k, -k, -k - 1);
    elements += fmt::format(
        "  e{0}: {{type: beam, nodes: [a{0}, b{0}], elements: 8, section: {{circle: 0.02, young: 7e10, poisson: 0.3, "
        "density: 2700}}}}\n",
        k);
    joints += fmt::format("  j{}: {{type: hinge, nodes: [{}, a{}], position: [0, 0, {}], axis: {}}}\n", k,
                          k == 0 ? "ground" : fmt::format("b{}", k - 1), k, -k, k % 2 ? "[1, 0, 0]" : "[0, 1, 0]");
  }
  return "gravity: [0, 0, -9.81]\nnodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints;
}

/// Computes responses at many frequencies, directly and as a sum over modes.
void compare_responses(Session& session, int count, double highest) {
  FrequencyResponseOptions options;
  const int first = *session.model().find_node("b0"), next = *session.model().find_node("b1");
  options.inputs = {{"force", first, false, Vector3::UnitX()}};
  options.outputs = {{"moves", next, false, Vector3::UnitX()}};
  constexpr int frequencies = 400;
  for (int k = 1; k <= frequencies; ++k) options.frequencies.push_back(highest * k / (1.5 * frequencies));
  const double start = processor_seconds();
  const FrequencyResponse direct = compute_frequency_response(session, options);
  const double middle = processor_seconds();
  options.modes = count;
  const FrequencyResponse sum = compute_frequency_response(session, options);
  const double end = processor_seconds();
  double largest = 0, worst = 0;
  for (const Eigen::MatrixXcd& H : direct.response) largest = std::max(largest, std::abs(H(0, 0)));
  for (int k = 0; k < frequencies; ++k) {
    const auto f = static_cast<std::size_t>(k);
    worst = std::max(worst, std::abs(sum.response[f](0, 0) - direct.response[f](0, 0)) / largest);
  }
  fmt::print(
      "{} frequencies: {:.2f} s directly, {:.2f} s by {} modes, {:.1f} times as fast; they differ by {:.1e} of the "
      "largest answer, told {:.1e}\n",
      frequencies, middle - start, end - middle, sum.modal->modes, (middle - start) / (end - middle), worst,
      sum.modal->deviation);
}

}  // namespace

int main(int argc, char** argv) {
  const int links = argc > 1 ? std::atoi(argv[1]) : 200, count = argc > 2 ? std::atoi(argv[2]) : 40;
  const MechanismFile file = read_mechanism_text(hanging_chain(links), "chain.yaml");
  double start = processor_seconds();
  const auto lap = [&] {
    const double now = processor_seconds(), time = now - start;
    start = now;
    return time;
  };
  Session session(file.model);
  const double setup = lap();
  compute_statics(session);
  const double statics = lap();
  ModesOptions options;
  options.search.count = count;
  const ModesReport report = compute_modes(session, options);
  const double modes = lap();
  constexpr double first_zero = 2.404825557695773;
  const double expected = first_zero * std::sqrt(9.81 / links) / (4 * std::numbers::pi);
  double residual = 0;
  for (const Mode& mode : report.found.modes) residual = std::max(residual, mode.residual);
  fmt::print("{} dofs, {} constraints: set up {:.2f} s, statics {:.2f} s, {} modes {:.2f} s of processor time\n",
             session.system().dofs(), session.system().multipliers(), setup, statics, report.found.modes.size(), modes);
  fmt::print("slowest {:.6g} Hz (heavy chain {:.6g} Hz), fastest found {:.6g} Hz, largest residual {:.1e}\n",
             report.found.modes.front().frequency(), expected, report.found.modes.back().frequency(), residual);
  compare_responses(session, count, report.found.modes.back().frequency());
}
