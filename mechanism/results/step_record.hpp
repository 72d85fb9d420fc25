// What a step reports in addition to the state.
#pragma once

#include <optional>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

struct StepRecord {
  Energy energy;               ///< stored energies now; dissipation and input are integrals over the analysis [J]
  double balance = 0;          ///< what is missing in the balance of energy [J]
  double step = 0;             ///< size of the step [s]
  int newton_iterations = 0;   ///< of the step
  double error_estimate = 0;   ///< of the step, relative to the tolerance; 0 when the step is fixed
  double worst_residual = 0;   ///< of the step, relative to its tolerance
  int worst_equation = -1;     ///< whose residual that is; -1: there is none
  std::optional<double> time;  ///< reported in place of the state's: the load factor of a static analysis
};

}  // namespace bielle::mechanism
