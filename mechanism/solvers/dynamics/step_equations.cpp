#include "mechanism/solvers/dynamics/step_equations.hpp"

namespace bielle::mechanism {

void StepEquations::calc_residual(const State& trial, const Environment& environment, VectorX& r,
                                  ResidualScale& scale) const {
  system_.residual(trial, environment, r, &scale);
}

void StepEquations::factor(const SchemeStep& step, const Environment& environment) {
  linear_.factor(step.trial(), environment, step.weights(), &step.dq());
}

}  // namespace bielle::mechanism
