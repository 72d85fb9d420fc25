// The error and stability of the forms of the scheme in relation to their cost: the measurement behind the defaults of
// dynamic analyses (mechanism/solvers/README.md).
//
//   performance_mechanism_forms
//
// Each model runs with constraints of index 3 and with stabilised ones, with several rho, in steps of several sizes.
// Errors are the largest ones over all steps, relative to a run in much smaller steps (stabilised, rho = 0.8): those of
// the positions of all nodes, and those of the multipliers of holonomic constraints relative to the largest multiplier.
// The cost is processor time.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "tests/performance/processor_time.hpp"
#include "tests/support/chain.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::performance;
using namespace bielle::test;

struct Case {
  const char* name;
  std::string text;
  double duration, longest;  ///< [s]; steps are longest, longest/2, longest/4
};

const char* name_of(ConstraintForm form) {
  switch (form) {
    case ConstraintForm::position:
      return "index 3";
    case ConstraintForm::corrected:
      return "corrected";
    case ConstraintForm::stabilised:
      break;
  }
  return "stabilised";
}

struct Samples {
  std::vector<VectorX> positions, multipliers;
  double seconds = 0;
  std::string failure;
};

/// Returns a run recorded at multiples of `every` steps.
Samples run(const MechanismFile& file, const System& system, const Scheme& scheme, ConstraintForm form, double h,
            double duration, long every) {
  Samples samples;
  const double start = processor_seconds();
  try {
    TimeIntegration integration(system, file.model.environment, scheme, system.start(0), form);
    integration.start(h);
    for (long k = 1; k <= std::lround(duration / h); ++k) {
      integration.step(h);
      if (k % every != 0) continue;
      const State& state = integration.state();
      VectorX x(3 * static_cast<Eigen::Index>(state.nodes.size()));
      for (std::size_t i = 0; i < state.nodes.size(); ++i)
        x.segment<3>(3 * static_cast<Eigen::Index>(i)) = state.nodes[i].x;
      samples.positions.push_back(x);
      samples.multipliers.push_back(state.multiplier);
    }
  } catch (const ComputationError& error) {
    samples.failure = error.what();
  }
  samples.seconds = processor_seconds() - start;
  return samples;
}

double largest_difference(const std::vector<VectorX>& a, const std::vector<VectorX>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, (a[k] - b[k]).cwiseAbs().maxCoeff());
  return largest;
}

void measure(const Case& subject) {
  const MechanismFile file = read_mechanism_text(subject.text, "model.yaml");
  System system(file.model);
  system.set_aside(find_redundant(system, file.model.environment, system.start(0)));
  constexpr long finest = 4, reference_parts = 64;
  const Samples reference = run(file, system, Scheme::generalized_alpha(0.8), ConstraintForm::stabilised,
                                subject.longest / reference_parts, subject.duration, reference_parts);
  double force = 0;
  for (const VectorX& lambda : reference.multipliers) force = std::max(force, lambda.cwiseAbs().maxCoeff());
  fmt::print("\n{}\n  {:<24}", subject.name, "");
  for (long parts = 1; parts <= finest; parts *= 2)
    fmt::print("  h = {:<9.3g} x        lambda   ms   ", subject.longest / static_cast<double>(parts));
  fmt::print("\n");
  for (const ConstraintForm form : {ConstraintForm::position, ConstraintForm::corrected, ConstraintForm::stabilised})
    for (const double rho : {0.5, 0.7, 0.8, 0.9, 0.95}) {
      fmt::print("  {:<11} rho = {:<5}", name_of(form), rho);
      for (long parts = 1; parts <= finest; parts *= 2) {
        const Samples samples = run(file, system, Scheme::generalized_alpha(rho), form,
                                    subject.longest / static_cast<double>(parts), subject.duration, parts);
        if (!samples.failure.empty())
          fmt::print("    {:<33}", "does not come to the end");
        else
          fmt::print("    {:>12.2e} {:>9.2e} {:>8.1f} ", largest_difference(samples.positions, reference.positions),
                     largest_difference(samples.multipliers, reference.multipliers) / force, 1e3 * samples.seconds);
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
}

const char* const heavy_top = R"yaml(
gravity: [0, 0, -9.81]
nodes: {top: {position: [0, 1, 0], velocity: [4.61538, 0, 0], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}
joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}
)yaml";

const char* const rotor = R"yaml(
nodes: {m: {position: [1, 0, 0], velocity: [0, "20*pi", 0], angular_velocity: [0, 0, "20*pi"]}}
elements: {m: {type: rigid_body, node: m, mass: 1, inertia: [0.01, 0.01, 0.01]}}
joints: {pivot: {type: hinge, nodes: [ground, m], position: [0, 0, 0], axis: [0, 0, 1]}}
)yaml";

// The data are those of B. Simeon's slider-crank, with a rod a hundred times softer than steel, so that the steps
// resolve all of its modes.
const char* const slider_crank = R"yaml(
nodes:
  crank: {position: [0.075, 0, 0], velocity: [0, 11.25, 0], angular_velocity: [0, 0, 150]}
  b: {position: [0.15, 0, 0], velocity: [0, 22.5, 0], angular_velocity: [0, 0, -75]}
  c: {position: [0.45, 0, 0], angular_velocity: [0, 0, -75]}
  slider: {position: [0.45, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 0.36, inertia: [1e-5, 2e-3, 2e-3]}
  rod: {type: beam, nodes: [b, c], elements: 4, section: {rectangle: [0.008, 0.008], young: 2e9, poisson: 0.3, density: 7870}}
  slider: {type: rigid_body, node: slider, mass: 0.075552, inertia: [1e-5, 1e-5, 1e-5]}
joints:
  main: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 0, 1]}
  big_end: {type: hinge, nodes: [crank, b], axis: [0, 0, 1]}
  wrist: {type: spherical, nodes: [c, slider]}
  guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}
drives: {motor: {joint: main, angle: "150*t"}}
)yaml";

}  // namespace

int main() {
  measure({"heavy top, 0.5 s (150 rad/s; its precession turns the pivot's directions)", heavy_top, 0.5, 4e-3});
  measure({"rotor without gravity, 10 revolutions per second, 1 s", rotor, 1, 8e-3});
  measure({"chain of 10 links, falling for 1 s", chain(10, spherical), 1, 8e-3});
  measure({"flexible slider-crank, 150 rad/s, 0.02 s", slider_crank, 0.02, 2e-5});
}
