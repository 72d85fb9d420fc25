// Report of a step, for statistics and messages.
#pragma once

#include <string>

namespace bielle::mechanism {

struct StepReport {
  double size = 0;            ///< step size h [s]
  int iterations = 0;         ///< iterations of Newton's method: linear solutions whose residual was evaluated
  int factorisations = 0;     ///< factorisations of the tangent
  int evaluations = 0;        ///< evaluations of the residual
  int solutions = 0;          ///< solutions with the factors
  int shortened = 0;          ///< iterations with a shortened step
  int order = 0;              ///< order of the extrapolation that gave the initial guess
  int worst_equation = -1;    ///< equation with the largest ratio to its tolerance at the end; -1: no residual at all
  double worst_residual = 0;  ///< residual of that equation, in its units
  double worst_ratio = 0;     ///< ratio to its tolerance
  std::string refusal;        ///< reason of the failure; empty if the step did not fail
  bool converged() const { return refusal.empty(); }
};

}  // namespace bielle::mechanism
