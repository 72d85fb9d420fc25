// What a step did, for those who count and explain.
#pragma once

#include <string>

namespace bielle::mechanism {

struct StepReport {
  double size = 0;            ///< h [s]
  int iterations = 0;         ///< of Newton's method: linear solves whose residual was looked at
  int factorisations = 0;     ///< of the tangent
  int evaluations = 0;        ///< of the residual
  int solutions = 0;          ///< with the factors
  int shortened = 0;          ///< iterations whose full step was too long
  int order = 0;              ///< of the extrapolation that the step has started from
  int worst_equation = -1;    ///< farthest from its tolerance at the end; -1: none is off at all
  double worst_residual = 0;  ///< of that equation, in its units
  double worst_ratio = 0;     ///< over its tolerance
  std::string refusal;        ///< why the step failed; empty when it did not
  bool converged() const { return refusal.empty(); }
};

}  // namespace bielle::mechanism
