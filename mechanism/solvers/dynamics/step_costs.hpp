// Costs of the operations of Newton's method in a step, counted for a model.
//
// They are estimated from the sizes of the members' local equations and from the operations and entries of the factors,
// with constants that were measured once (step_costs.cpp). No clock is read: a run stays the same to the bit on any
// machine, whatever other work it does. Only their ratios matter.
#pragma once

#include "mechanism/math/sparse_factors.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Estimated times [ns] on the machine on which the constants were measured.
struct StepCosts {
  double evaluation = 0;     ///< evaluation of the residual, including the motion of the nodes
  double factorisation = 0;  ///< factorisation, including its tangent
  double solution = 0;       ///< solution with the factors
};

/// @param equations  number of equations of a step
/// @param tangents   number of tangents of the system that a factorisation needs
/// @param factors    cost of the last factorisation
StepCosts count_costs(const System& system, int equations, int tangents, const FactorCost& factors);

}  // namespace bielle::mechanism
