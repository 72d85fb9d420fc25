// Mechanisms of ten times as many parts take about ten times the processor time and memory until they move: they are
// read, described as by --check, set up and started, and make their first steps. Work for each part that passes over
// all other parts grows a hundredfold.
#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "tests/support/large_models.hpp"

using namespace bielle::mechanism;
using bielle::test::LargeModel;

namespace {

void set_off(const std::string& text) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  describe_model(file);
  System system(file.model);
  State state = system.start(0);
  take_out_redundant(system, file.model.environment, state);
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), state);
  constexpr double step = 1e-4;
  integration.start(step);
  for (int k = 0; k < 3; ++k) integration.step(step);
}

struct Cost {
  double seconds = std::numeric_limits<double>::infinity();  ///< processor time [s]
  double memory = std::numeric_limits<double>::infinity();   ///< peak
};

/// The least cost of several runs, each in a process of its own. Other work on the machine lengthens some.
Cost cost_of(const LargeModel& model, int parts) {
  const std::string text = model.text(parts);
  Cost least;
  for (int run = 0; run < 3; ++run) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      int status = 0;
      try {
        set_off(text);
      } catch (...) {
        status = 1;
      }
      std::_Exit(status);
    }
    int status = 0;
    rusage usage{};
    REQUIRE(wait4(child, &status, 0, &usage) == child);
    REQUIRE(status == 0);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    least.seconds = std::min(least.seconds, seconds(usage.ru_utime) + seconds(usage.ru_stime));
    least.memory = std::min(least.memory, static_cast<double>(usage.ru_maxrss));
  }
  return least;
}

}  // namespace

TEST_CASE("ten times the parts take about ten times the time and memory to be read, checked and set off") {
  for (const LargeModel& model : bielle::test::large_models()) {
    // A thousand parts fit into the caches of a processor and ten thousand do not, which alone is a third more per
    // part: models are compared beyond that size. Loops have four joints each.
    const int parts = model.name == "loops" ? 300 : 3000;
    // Orderings and sorted names take n log n: 13 to 14 times.
    const double longest = 10 * std::log(10.0 * parts) / std::log(1.0 * parts);
    const Cost few = cost_of(model, parts), many = cost_of(model, 10 * parts);
    CAPTURE(model.name, few.seconds, many.seconds, few.memory, many.memory);
    CHECK(many.seconds <= longest * few.seconds);
    CHECK(many.memory <= 12 * few.memory);
  }
}
