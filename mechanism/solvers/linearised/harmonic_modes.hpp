// Modes of equations with periodic coefficients: Floquet exponents and shapes (harmonic_equations.hpp).
//
// Each motion occurs with the exponents s + i k rate, k = .., -1, 0, 1, ... The principal one is that whose largest
// harmonic of the standing part is constant (the frequency that an observer on the standing part measures); if the
// standing part does not move, that of the turning part.
#pragma once

#include "mechanism/solvers/linearised/harmonic_equations.hpp"
#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

/// Dependence of the coefficients on the azimuth of the turning part, the simplest first.
enum class Periodicity {
  negligible,  ///< the rate is negligible compared with all frequencies: the equations are those at rest
  constant,    ///< constant in axes that turn with the part
  multiblade,  ///< constant in multiblade coordinates: one harmonic is exact
  periodic     ///< periodic in any coordinates
};

struct HarmonicModes {
  Periodicity periodicity = Periodicity::constant;
  int harmonics = 0;                   ///< h
  double change = 0;                   ///< largest change of an exponent by one more harmonic, relative to the rates
  LinearisedEquations equations;       ///< of the harmonics
  Modes found;                         ///< shapes of the harmonics
  std::vector<Eigen::MatrixXcd> u, w;  ///< amplitudes of each mode at harmonics -h .. h (columns)
  /// Sense of the motion of the turning part around the axis for each mode: 1 if its pattern runs forwards, -1
  /// backwards, between for sums of both; NaN if less than a tenth of its motion runs around, or without a standing
  /// part.
  std::vector<double> whirl;
};

class HarmonicSearch {
 public:
  /// @param turning  for each unknown, whether it belongs to the turning part @param shift  coefficients of the shift
  /// of a periodic motion in time (periodic_orbit.hpp), which is a rigid mode; empty: there is none
  HarmonicSearch(const PeriodicEquations& equations, std::vector<char> turning, MatrixX shift = {})
      : equations_(equations), turning_(std::move(turning)), shift_(std::move(shift)) {}

  /// Finds the modes with as many harmonics as they need, at least with the given number.
  /// @throws ComputationError if they need too many
  HarmonicModes find(const ModeOptions& options, int least = 1) const;

 private:
  HarmonicModes find_with(const ModeOptions& options, int harmonics) const;
  struct Sizes;
  Sizes sizes_of(const Eigen::MatrixXcd& u, std::complex<double> s) const;
  bool is_shift(const Eigen::MatrixXcd& u, std::complex<double> s) const;
  VectorX weights(double rate) const;
  VectorX of_harmonics(const MatrixX& coefficients, int h) const;
  void add_shift(HarmonicModes& result) const;
  bool is_principal(const Sizes& sizes) const;
  double whirl_of(const Sizes& sizes) const;
  bool take(const Modes& found, const ModeOptions& options, HarmonicModes& result) const;
  double change_by_next(const HarmonicModes& modes) const;

  const PeriodicEquations& equations_;
  std::vector<char> turning_;
  MatrixX shift_;
};

}  // namespace bielle::mechanism
