// Steps through a span of time: fixed or adaptive steps, ends on kinks, smaller steps where Newton's method fails.
//
// Fixed steps keep to their grid; between two of its times smaller steps are taken only where a kink lies there or
// where Newton's method failed. Adaptive steps keep the local error of each step (error_norm.hpp) below a tolerance:
// the next size is h * 0.9 (tolerance/error)^(1/3), at most doubled, and stays where it would change by little, because
// a change costs a factorisation.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mechanism/solvers/time_integration.hpp"

namespace bielle::mechanism {

struct StepOptions {
  double size = 0;                                           ///< [s] fixed, or tried first
  double tolerance = 0;                                      ///< of the local error; 0: fixed steps
  double largest = std::numeric_limits<double>::infinity();  ///< [s] adaptive steps only
  /// Times at which forces or prescribed motions have kinks. Those outside the span do not matter.
  std::vector<double> break_points;
};

/// An accepted step.
struct MarchStep {
  const StepReport& report;
  double error = 0;     ///< local error over tolerance; 0 with fixed steps
  bool on_grid = true;  ///< ends on a time of the fixed grid; always true with adaptive steps
};

/// What a march did.
struct MarchLog {
  long steps = 0, iterations = 0;    ///< accepted steps; linear solves, those of refused steps included
  long refused_by_error = 0;         ///< steps whose local error was too large
  long refused_by_newton = 0;        ///< steps in which Newton's method failed
  double smallest = 0, largest = 0;  ///< accepted steps [s], those cut short by the end or by kinks left out
  std::string hardest;               ///< why a step was last refused; empty when none was
  int most_iterations = 0;           ///< of an accepted step
  double most_iterations_at = 0;     ///< [s]
};

/// Integrates to `end`. @param after_step  called after every accepted step
/// @throws ComputationError when Newton's method fails with the smallest steps too: 1/1024 of the fixed size, or 1e-10
/// of the span
MarchLog march(TimeIntegration& integration, double end, const StepOptions& options,
               const std::function<void(const MarchStep&)>& after_step);

}  // namespace bielle::mechanism
