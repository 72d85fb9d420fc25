// The cost of friction in joints: chains of hinges without it, and with each of its models.
//
//   performance_mechanism_friction [LINKS ...]      default 1 10 100
//
// Chains as in chain.hpp are released from the horizontal and run for 1 s in steps of 1 ms. The figure is the least
// processor time per step of the computing thread of three runs, also relative to the chain without friction; all runs
// are in one run of the program.
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/performance/processor_time.hpp"
#include "tests/support/chain.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;

double measure(int links, const std::string& what, const std::string& friction, double compared) {
  const std::string joint =
      test::hinge + (friction.empty() ? "" : ", friction: {radius: 0.02, coefficient: 0.1, " + friction + "}");
  const MechanismFile file = read_mechanism_text(test::chain(links, joint), "chain.yaml");
  double least = std::numeric_limits<double>::infinity();
  MarchLog log;
  for (int round = 0; round < 3; ++round) {
    Session session(file.model);
    DynamicsOptions options;
    options.duration = 1;
    options.stepping.size = 1e-3;
    Motion motion = session.dynamics(options);
    const double begin = performance::processor_seconds();
    motion.finish();
    log = motion.log();
    least = std::min(least, (performance::processor_seconds() - begin) / static_cast<double>(log.steps));
  }
  fmt::print("{:4} links, {:<12} {:9.1f} us per step, {:4.1f} iterations, {:6} factorisations, {:6} events", links,
             what, 1e6 * least, static_cast<double>(log.iterations) / static_cast<double>(log.steps),
             log.factorisations, log.crossings);
  if (compared > 0) fmt::print(", {:6.2f} times", least / compared);
  fmt::print("\n");
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int k = 1; k < argc; ++k) sizes.push_back(std::atoi(argv[k]));
  if (sizes.empty()) sizes = {1, 10, 100};
  for (const int links : sizes) {
    const double without = measure(links, "none", "", 0);
    measure(links, "coulomb", "velocity: 0.01", without);
    measure(links, "lugre", "model: lugre, bristle_stiffness: 1e3, bristle_damping: 5", without);
    measure(links, "stick_slip", "model: stick_slip", without);
  }
}
