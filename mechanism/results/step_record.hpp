// Data that a step reports in addition to the state.
#pragma once

#include <optional>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

struct StepRecord {
  Energy energy;               ///< present stored energies; dissipation and input are integrals over the analysis [J]
  double balance = 0;          ///< missing energy in the energy balance [J]
  double step = 0;             ///< size of the step [s]
  int newton_iterations = 0;   ///< iterations of the step
  double error_estimate = 0;   ///< error of the step, relative to the tolerance; 0 for fixed steps
  double worst_residual = 0;   ///< largest residual of the step, relative to its tolerance
  int worst_equation = -1;     ///< number of the equation with this residual; -1: none
  std::optional<double> time;  ///< reported instead of the state's time: the load factor of a static analysis
};

}  // namespace bielle::mechanism
