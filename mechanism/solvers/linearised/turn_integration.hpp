// Motions of equations with periodic coefficients over one turn of the azimuth, by time integration.
//
// At each azimuth (equations.hpp)
//     M w' + C w + K u + (B^T + F) l = 0,     w = u' + W u,     B u = 0 or B w + S u = 0.
// The method is Radau IIA with three stages, of order five (E. Hairer, G. Wanner, Solving Ordinary Differential
// Equations II, Springer, 1996, IV.5): it satisfies the constraints at the end of each step, and damps motions that are
// too fast for the step. With its matrix A and the step t, D = A^-1/t and g = D [1, 1, 1], the stages have
//     w_i = sum_j D_ij u_j - g_i u_0 + W u_i,     w'_i = sum_j D_ij w_j - g_i w_0,
// so that only u_i and l_i remain in the equations of a step.
#pragma once

#include <functional>

#include "mechanism/solvers/linearised/harmonic_equations.hpp"

namespace bielle::mechanism {

class TurnIntegration {
 public:
  /// @param steps  number of equal steps of a turn
  TurnIntegration(const PeriodicEquations& equations, int steps);

  int steps() const { return steps_; }
  double duration() const;  ///< time of a turn [s]
  /// Receives the number of a step, 0 .. steps - 1, and the states at its begin.
  using Observer = std::function<void(int step, const MatrixX& states)>;
  /// Returns the states after a turn that begins at azimuth 0. States that violate the constraints are projected by the
  /// first step. @param states  (states, any): [u; w] in columns, rates w of the dofs
  /// @throws ComputationError if the equations of a step are singular
  MatrixX after_turn(MatrixX states, const Observer& observe = {}) const;

 private:
  const PeriodicEquations& equations_;
  int steps_;
};

}  // namespace bielle::mechanism
