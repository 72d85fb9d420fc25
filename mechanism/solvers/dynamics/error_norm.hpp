// How large the local error of a step is relative to the mechanism: a number that does not depend on units.
//
//   error = max( sqrt(sum m_i e_i^2 / M) / L,  sqrt(sum J_i e_i^2 / J),  |e_y| / max(|y|, s) )
// e the errors of displacements and amplitudes, of rotations, and of first-order unknowns; m and J the diagonal of the
// mass matrix, M and J their means over directions, so that a common displacement d gives |d|/L and a common turn its
// angle; L the extent of the mechanism; |y| the value of each first-order unknown, and s its scale; of one without a
// scale the largest value that it has had, alone. Algebraic unknowns follow from the others, and do not count.
#pragma once

#include "mechanism/solvers/dynamics/time_integration.hpp"

namespace bielle::mechanism {

class ErrorNorm {
 public:
  ErrorNorm(const System& system, const Environment& environment, const State& state);
  /// @param integration  with an attempted step. @returns [-]
  double operator()(const TimeIntegration& integration);
  /// The error of positions after a step in which an impulse was missed, were nothing held.
  /// @param impulse  along each equation (size): of forces [N s], [N m s]
  /// @param h        of the step [s]
  double of_impulse(const VectorX& impulse, double h) const;
  double length() const { return length_; }  ///< L [m]
  void exchange(Archive& archive);

 private:
  double of_positions(const VectorX& e) const;
  const System& system_;
  VectorX mass_;                           ///< diagonal of the mass matrix (dofs)
  double mass_sum_ = 0, inertia_sum_ = 0;  ///< of the means over directions
  double length_ = 1;
  VectorX largest_first_order_;
  std::vector<bool> algebraic_;  ///< of each first-order unknown
};

}  // namespace bielle::mechanism
