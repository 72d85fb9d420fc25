// Equilibrium of a session.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/session/session.hpp"
#include "mechanism/solvers/start/start_report.hpp"
#include "mechanism/solvers/statics/arc_length.hpp"
#include "mechanism/solvers/statics/statics.hpp"

namespace bielle::mechanism {

struct StaticsOptions {
  int steps = 1;                    ///< equal increments of the load factor; 0: chosen by the program
  double branch = 0;                ///< follows branches of load steps, see LoadSteps
  std::optional<PathOptions> path;  ///< follows a path past limit points in place of load steps
  NewtonOptions newton;
};

struct StaticsReport {
  StartReport start;  ///< what had to be brought together first
  long points = 0;
  long iterations = 0;               ///< linear solves that led to the points
  StaticsLog log;                    ///< of load steps: stability, what was refused, and what all of it cost
  double load_factor = 0;            ///< at the end
  std::vector<double> limit_points;  ///< load factors at the maxima and minima of a path
};

/// Equilibrium under the whole load, or along a path. The state is at rest afterwards.
/// @throws ComputationError when there is none near; the state is then the last equilibrium
StaticsReport compute_statics(Session& session, const StaticsOptions& options = {});

}  // namespace bielle::mechanism
