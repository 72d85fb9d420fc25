// Statistics of a motion's steps.
#pragma once

#include <string>

#include "mechanism/model/archive.hpp"

namespace bielle::mechanism {

/// Statistics of a march.
struct MarchLog {
  long steps = 0, iterations = 0;    ///< accepted steps; linear solves, including those of rejected steps
  long factorisations = 0;           ///< factorisations of the tangent
  long shortened = 0;                ///< iterations with a shortened step
  long refused_by_error = 0;         ///< steps with too large a local error
  long refused_by_newton = 0;        ///< steps in which Newton's method failed
  long crossings = 0;                ///< number of events
  double smallest = 0, largest = 0;  ///< range of accepted steps [s], without those shortened by kinks
  int most_iterations = 0;           ///< largest number in an accepted step
  double most_iterations_at = 0;     ///< time of that step [s]
  int slowest_equation = -1;         ///< equation with the largest residual at the end of that step; -1: none
  std::string hardest;               ///< reason of the last rejected step; empty if none was rejected

  void exchange(Archive& archive, int equations);    ///< all except the text
  MarchLog followed_by(const MarchLog& next) const;  ///< combined log of both
};

}  // namespace bielle::mechanism
