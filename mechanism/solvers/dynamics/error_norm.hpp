// The size of a step's local error relative to the mechanism: a number that does not depend on units.
//
//   error = max( sqrt(sum m_i e_i^2 / M) / L,  sqrt(sum J_i e_i^2 / J),  |e_y| / max(|y|, s) )
// Here e are the errors of displacements and amplitudes, of rotations, and of first-order unknowns; m and J are the
// diagonal of the mass matrix, M and J their means over directions, so that a common displacement d gives |d|/L and a
// common rotation its angle; L is the extent of the mechanism; |y| is the value of each first-order unknown, and s its
// scale; for an unknown without a scale, its largest value so far is used instead. Algebraic unknowns follow from the
// others, and are not included.
#pragma once

#include "mechanism/solvers/dynamics/time_integration.hpp"

namespace bielle::mechanism {

class ErrorNorm {
 public:
  ErrorNorm(const System& system, const Environment& environment, const State& state);
  /// @param integration  time integration with an attempted step. @returns [-]
  double operator()(const TimeIntegration& integration);
  /// Error of positions after a step in which an impulse was omitted, for free bodies.
  /// @param impulse  impulse on each equation (size): for forces [N s], [N m s]
  /// @param h        size of the step [s]
  double of_impulse(const VectorX& impulse, double h) const;
  double length() const { return length_; }  ///< L [m]
  void exchange(Archive& archive);

 private:
  double of_positions(const VectorX& e) const;
  const System& system_;
  VectorX mass_;                           ///< diagonal of the mass matrix (dofs)
  double mass_sum_ = 0, inertia_sum_ = 0;  ///< sums of the means over directions
  double length_ = 1;
  VectorX largest_first_order_;
  std::vector<bool> algebraic_;  ///< for each first-order unknown
};

}  // namespace bielle::mechanism
