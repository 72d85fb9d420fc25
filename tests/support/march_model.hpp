// Marches through the motion of a model written as text, for tests of steps.
#pragma once

#include <string>
#include <vector>

#include "mechanism/solvers/dynamics/march.hpp"
#include "tests/support/run_model.hpp"

namespace bielle::test {

struct Visit {
  double time, size, error;
  bool on_grid;
};

struct Course {
  std::vector<Visit> visits;
  mechanism::MarchLog log;
  mechanism::State end;
  std::vector<std::string> warnings;
};

inline Course march(const ReadyModel& model, double end, mechanism::StepOptions options) {
  using namespace mechanism;
  options.break_points = model.system.break_points();
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  Course motion;
  March march(integration, integration.state().time, end, options);
  while (!march.done()) {
    const MarchStep step = march.advance();
    motion.visits.push_back({integration.state().time, step.report.size, step.error, step.on_grid});
  }
  motion.log = march.log();
  motion.warnings = march.warnings();
  motion.end = integration.state();
  return motion;
}

inline mechanism::StepOptions fixed_steps(double size) {
  mechanism::StepOptions options;
  options.size = size;
  return options;
}

inline mechanism::StepOptions adaptive_steps(double size, double tolerance) {
  mechanism::StepOptions options;
  options.size = size;
  options.tolerance = tolerance;
  return options;
}

}  // namespace bielle::test
