// Modes of equations with periodic coefficients: Floquet exponents and shapes (harmonic_equations.hpp).
//
// All modes are searched for once, with few harmonics. Each is then continued with more harmonics by inverse iteration
// until these change its exponent no more. The slower the rotation, the more harmonics are necessary: about as many as
// the rate is contained in the change of a frequency over a turn.
#pragma once

#include "mechanism/solvers/linearised/harmonic_continuation.hpp"

namespace bielle::mechanism {

class HarmonicSearch {
 public:
  /// @param turning  for each unknown, whether it belongs to the turning part @param shift  coefficients of the shift
  /// of a periodic motion in time (periodic_orbit.hpp), which is a rigid mode; empty: there is none
  HarmonicSearch(const PeriodicEquations& equations, std::vector<char> turning, MatrixX shift = {})
      : equations_(equations), shapes_(equations, std::move(turning), std::move(shift)) {}

  /// Finds the modes with as many harmonics as they need, at least with the given number.
  /// @throws ComputationError if they need too many
  HarmonicModes find(const ModeOptions& options, int least = 1) const;

 private:
  HarmonicModes find_with(const ModeOptions& options, int harmonics) const;
  void add_shift(HarmonicModes& result) const;
  bool is_complete(const HarmonicModes& modes) const;
  bool counts_shift_twice(const HarmonicModes& modes) const;
  bool is_phase(std::complex<double> s, const HarmonicSizes& sizes) const;
  bool take(Modes found, const ModeOptions& options, HarmonicModes& result) const;

  const PeriodicEquations& equations_;
  HarmonicShapes shapes_;
};

}  // namespace bielle::mechanism
