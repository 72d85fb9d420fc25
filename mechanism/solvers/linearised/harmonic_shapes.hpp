// Shapes of modes of equations with periodic coefficients: sizes of their harmonics, and what follows from these.
//
// Each motion occurs with the exponents s + i k rate, k = .., -1, 0, 1, ... The principal one is that whose largest
// harmonic of the standing part is constant (the frequency that an observer on the standing part measures); if the
// standing part does not move, that of the turning part.
#pragma once

#include <complex>
#include <utility>
#include <vector>

#include "mechanism/solvers/linearised/harmonic_equations.hpp"

namespace bielle::mechanism {

/// Sums of kinetic and potential energies of single unknowns, which need no inertia, for harmonics -h .. h.
struct HarmonicSizes {
  VectorX standing, turning;

  /// Harmonic at which the part is largest that decides which exponent is the principal one: 0 for the principal one,
  /// and for one of several equals (a motion that is locked to the rotation).
  int largest() const;
};

class HarmonicShapes {
 public:
  /// @param turning  for each unknown, whether it belongs to the turning part @param shift  coefficients of the shift
  /// of a periodic motion in time (periodic_orbit.hpp); empty: there is none
  HarmonicShapes(const PeriodicEquations& equations, std::vector<char> turning, MatrixX shift)
      : equations_(equations), turning_(std::move(turning)), shift_(std::move(shift)) {}

  bool any_shift() const { return shift_.size() > 0; }
  /// Returns the shift in time in the order of the equations of h harmonics.
  VectorX shift(int h) const { return of_harmonics(shift_, h); }
  /// Returns factors of the squared amplitudes of unknowns that make energies of them, in the order of the equations of
  /// h harmonics. @param rate  [rad/s]
  VectorX weights(double rate, int h) const;
  /// @param u  amplitudes of harmonics (columns) @param s  exponent
  HarmonicSizes sizes(const Eigen::MatrixXcd& u, std::complex<double> s) const;
  /// Returns the sense of the motion of the turning part around the axis: 1 if its pattern runs forwards, -1 backwards,
  /// a value between for sums of both; NaN if less than a tenth of its motion runs around, or without a standing part.
  double whirl(const HarmonicSizes& sizes) const;
  /// Returns whether two modes with as many harmonics are one motion: their exponents, or the conjugate of one, differ
  /// by a multiple of i rate, and their harmonics are the same.
  /// @param alike  square of the cosine between shapes of one exponent from which on they are the same: two modes of an
  /// exponent may be any two of its shapes, which are nearly parallel by chance
  bool are_same(const Eigen::MatrixXcd& u, std::complex<double> s, const Eigen::MatrixXcd& other,
                std::complex<double> of_other, double alike = 1 - 1e-6) const;
  /// Square of the cosine between two shapes with as many harmonics, 0..1.
  double similarity(const Eigen::MatrixXcd& u, const Eigen::MatrixXcd& other) const;
  /// Squares of the cosines between a shape and the copies of another one that are moved by k harmonics, k = -h .. h:
  /// a motion of which the copy k is a part has nearly the exponent of the other one less i k rate.
  VectorX similarities(const Eigen::MatrixXcd& u, const Eigen::MatrixXcd& other) const;
  /// Whether a mode is the shift of the motion in time, or a copy of it. (A mode in resonance with the rotation has
  /// another shape.)
  bool is_shift(const Eigen::MatrixXcd& u, std::complex<double> s) const;

 private:
  VectorX weights(double rate) const;
  VectorX of_harmonics(const MatrixX& coefficients, int h) const;

  const PeriodicEquations& equations_;
  std::vector<char> turning_;
  MatrixX shift_;
};

}  // namespace bielle::mechanism
