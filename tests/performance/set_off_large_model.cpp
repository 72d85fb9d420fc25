// set_off_large_model MODEL PARTS: reads, describes, sets up and starts a mechanism of many parts, as --check does, and
// makes its first steps. tests/performance/growth counts its cost.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "tests/support/large_models.hpp"

namespace {

void set_off(const std::string& text) {
  using namespace bielle::mechanism;
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

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fputs("usage: set_off_large_model MODEL PARTS\n", stderr);
    return 2;
  }
  for (const bielle::test::LargeModel& model : bielle::test::large_models()) {
    if (model.name != arguments[1]) continue;
    set_off(model.text(std::atoi(arguments[2])));
    return 0;
  }
  std::fprintf(stderr, "there is no model %s\n", arguments[1]);
  return 2;
}
