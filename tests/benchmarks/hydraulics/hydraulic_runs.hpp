// Runs of models with hydraulics, for benchmarks.
#pragma once

#include <functional>
#include <string>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::test {

struct HydraulicRun {
  double h = 1e-3, end = 1;
  double tolerance = 0;  ///< adaptive steps
  double rho = 0.8;
};

/// @param look  called at the start and after every step
inline mechanism::MarchLog run_hydraulics(const std::string& text, const HydraulicRun& run,
                                          const std::function<void(const mechanism::Session&)>& look = {}) {
  const mechanism::MechanismFile file = mechanism::read_mechanism_text(text, "model.yaml");
  mechanism::Session session(file.model);
  mechanism::DynamicsOptions options;
  options.duration = run.end;
  options.stepping.size = run.h;
  options.stepping.tolerance = run.tolerance;
  options.scheme = mechanism::Scheme::generalized_alpha(run.rho);
  mechanism::Motion motion = session.dynamics(options);
  if (look) look(session);
  while (motion.step())
    if (look) look(session);
  return motion.log();
}

/// Returns a number of the results at the end of a run.
inline std::vector<double> at_end(const std::string& text, const HydraulicRun& run,
                                  const std::vector<std::string>& datasets) {
  std::vector<double> last;
  run_hydraulics(text, run, [&](const mechanism::Session& session) {
    last.clear();
    for (const std::string& dataset : datasets)
      for (const double value : session.read(dataset)) last.push_back(value);
  });
  return last;
}

}  // namespace bielle::test
