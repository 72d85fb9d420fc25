// Linearised equations with coefficients that are periodic in the azimuth psi = rate t, as equations with constant
// coefficients for harmonics of the motion (G. W. Hill, Acta Math. 8 (1886) 1).
//
// With f_0 = 1, f_(2m-1) = cos m psi, f_2m = sin m psi, m = 1 .. h, the unknowns are
//     u(t) = sum_p y_p(t) e_p(psi),     and multipliers likewise,
// where e_p are the functions f_p with the mean square 1. The equations are projected on the same functions, so that
// constraints and their forces remain each other's transpose. Rates become dy/dt + D y with the matrix D of the
// derivatives of e by time. Exponents s of y are Floquet exponents; s + i k rate, with harmonics moved by k, is the
// same motion, and they converge faster than any power of 1/h.
//
// If the standing part moves with the harmonic 0 alone and the turning part with 0 and +-1, the result is exact for
// h = 1: these are the multiblade coordinates (R. P. Coleman, A. M. Feingold, NACA TR 1351 (1958)) of rotors with three
// or more equal blades, and discs, on supports of any kind.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

/// Coefficients of a periodic matrix for the functions f_p.
using HarmonicMatrix = std::vector<LinearisedEquations::Sparse>;

class PeriodicEquations {
 public:
  /// @param azimuths  equations at equidistant azimuths (azimuth_equations.hpp), an even number
  /// @param rate  rate of the azimuth [rad/s] @param length  the mechanism's size [m], over which forces are rounded
  PeriodicEquations(const std::vector<LinearisedEquations>& azimuths, double rate, double length);

  double rate() const { return rate_; }
  /// Whether there are enough azimuths for the harmonics of the coefficients.
  bool resolved() const { return resolved_; }
  /// Whether the coefficients do not depend on the azimuth.
  bool constant() const { return constant_; }
  const LinearisedEquations& first() const { return first_; }  ///< the equations at azimuth 0
  /// Returns the equations at an azimuth [rad]. Matrices have the same pattern at all azimuths.
  LinearisedEquations at(double psi) const;
  /// Returns the equations of the harmonics up to h; for h = 0 the mean equations.
  LinearisedEquations of_harmonics(int h) const;
  /// Value of e_p at an azimuth [rad].
  static double function(int p, double psi);
  /// Index of an unknown of u in the equations of the harmonics. @param function  p of f_p
  int index(int function, int unknown, int h) const;
  /// Returns the complex amplitudes of exp((s + i k rate) t), k = -h .. h, in columns. @param y  (unknowns, or dofs, of
  /// the harmonics)
  Eigen::MatrixXcd amplitudes(const Eigen::VectorXcd& y, int h) const;
  /// Returns the coefficients y of the functions e_p for such amplitudes.
  Eigen::VectorXcd coefficients(const Eigen::MatrixXcd& amplitudes) const;

 private:
  double rate_;
  bool resolved_ = true, constant_ = true;
  LinearisedEquations first_;
  HarmonicMatrix M_, C_, K_, B_, S_, F_;
};

}  // namespace bielle::mechanism
