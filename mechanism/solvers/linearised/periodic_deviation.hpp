// Deviation of a periodic motion from the mean state of a mechanism with a turning part, as a Fourier series in the
// azimuth psi = rate t of the part (turning_part.hpp).
//
// With the functions e_p of harmonic_equations.hpp, q(psi) = sum_p q_p e_p(psi), p = 0 .. 2 h. Positions of nodes are
// displaced by q in axes that turn with the part (for its nodes; inertial ones otherwise), their orientations are
// R_mean exp(q), amplitudes and first-order unknowns have the increment q. Multipliers of the combined rows have the
// increment l(psi).
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

struct PeriodicDeviation {
  double rate = 0;    ///< rate of the azimuth [rad/s]
  int harmonics = 0;  ///< h
  MatrixX q;          ///< (unknowns, 2 h + 1)
  MatrixX l;          ///< (constraints, 2 h + 1)

  VectorX at(double psi) const { return q * functions(psi, 0); }
  VectorX rate_at(double psi) const { return q * functions(psi, 1); }          ///< dq/dt
  VectorX acceleration_at(double psi) const { return q * functions(psi, 2); }  ///< d2q/dt2
  VectorX multipliers_at(double psi) const { return l * functions(psi, 0); }
  /// Adds harmonics that are zero. @param more  the new number h
  void extend(int more);
  /// Returns the size of each harmonic of an unknown: that of its mean, and half the lengths of its ranges, k = 0 .. h.
  VectorX sizes(int unknown) const;

 private:
  /// Returns the derivatives of all e_p by time.
  VectorX functions(double psi, int derivative) const;
};

}  // namespace bielle::mechanism
