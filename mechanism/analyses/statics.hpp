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
  int steps = 1;  ///< number of equal increments of the load factor; 0: chosen automatically
  /// Deflection by which load steps follow a branch, see LoadSteps; 0: they do not.
  double branch = 0;
  std::optional<ContinuationOptions> path;  ///< if set, follows a path past limit points instead of load steps
  NewtonOptions newton;
};

struct StaticsReport {
  StartReport start;  ///< changes made by the initial assembly
  long points = 0;
  long iterations = 0;               ///< number of linear solutions for the points
  StaticsLog log;                    ///< log of the load steps: stability, rejected steps, and total cost
  double load_factor = 0;            ///< load factor at the end
  std::vector<double> limit_points;  ///< load factors at the maxima and minima of a path
};

/// Finds the equilibrium under the whole load, or along a path. The state is at rest afterwards.
/// @throws ComputationError if there is no equilibrium nearby; the state is then the last equilibrium found
StaticsReport compute_statics(Session& session, const StaticsOptions& options = {});

}  // namespace bielle::mechanism
