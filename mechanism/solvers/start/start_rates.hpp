// Rates of coordinates that are prescribed at a start, in addition to velocities that satisfy the constraints.
//
//   min |dv|_M   with   B dv = 0,   W (v + dv) = w:       dv = Z S^-1 (w - W v),   [M B^T; B 0][Z; .] = [W^T; 0],   S =
//   W Z
//
// A rate that follows from the constraints and earlier rates has no effect: it must agree with them.
#pragma once

#include <vector>

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// @param state   state with consistent positions and velocities
/// @param saddle  contains the factors of these positions
/// @throws ComputationError naming a rate that contradicts constraints, drives or earlier rates
void set_start_rates(const System& system, const Environment& environment, State& state,
                     const StartConditions& conditions, KktMatrix& saddle, StartReport& report);

/// Returns for each row over the dofs whether it depends on the constraints and earlier rows; zero rows do.
std::vector<bool> dependent_rows(const System& system, const Environment& environment, const State& state,
                                 const std::vector<VectorX>& rows);

}  // namespace bielle::mechanism
