// Modes of equations with periodic coefficients: Floquet exponents and shapes (harmonic_equations.hpp).
//
// Modes for which one harmonic is exact are searched for with it. Others are found by the monodromy matrix
// (floquet_motions.hpp), or by searches with more harmonics if it does not show them, and continued with more harmonics
// by inverse iteration until these change no exponent. The slower the rotation, the more harmonics are necessary: about
// as many as the rate is contained in the change of a frequency over a turn.
//
// About a periodic motion of equal blades the modes are continued from those about its mean state, which one harmonic
// of the rotation contains, or chosen among all motions by their shapes (modes_around_mean.hpp). The exponent that
// represents a motion is then the one into which that of the mean state goes over. At a rate so slow that the limit of
// harmonics does not contain the modulation of a frequency over a turn, a motion has no line of its own but a band,
// whose middle is the frequency about the mean state: the modes are those of the mean equations there.
#pragma once

#include <memory>

#include "mechanism/solvers/linearised/harmonic_continuation.hpp"

namespace bielle::mechanism {

class HarmonicSearch {
 public:
  /// @param turning  for each unknown, whether it belongs to the turning part @param shift  coefficients of the shift
  /// of a periodic motion in time (periodic_orbit.hpp), which is a rigid mode; empty: there is none
  /// @param mean  equations about the mean state of that motion; must outlive this object
  HarmonicSearch(const PeriodicEquations& equations, const std::vector<char>& turning, MatrixX shift = {},
                 const PeriodicEquations* mean = nullptr)
      : equations_(equations), shapes_(equations, turning, std::move(shift)) {
    if (mean) mean_ = std::make_unique<const HarmonicSearch>(*mean, turning);
  }

  /// Finds the modes with as many harmonics as they need, at least with the given number.
  /// @throws ComputationError if they need too many and have no modes of mean equations in their place
  HarmonicModes find(const ModeOptions& options, int least = 1) const;

  /// As `find`, about the periodic motion alone. @throws ComputationError if the modes need too many harmonics
  HarmonicModes find_resolved(const ModeOptions& options) const;

 private:
  HarmonicModes find_with(const ModeOptions& options, int harmonics) const;
  std::optional<HarmonicModes> motions_over_turn(const ModeOptions& options, HarmonicModes known) const;
  HarmonicModes find_freely(const ModeOptions& options, int least) const;
  HarmonicModes find_resonant(const ModeOptions& options, int least) const;
  std::optional<HarmonicModes> motions_over_turn_from(const HarmonicModes& mean, int most) const;
  HarmonicModes find_from(const HarmonicModes& mean, const ModeOptions& options, int least) const;
  std::optional<HarmonicModes> modes_of_mean(const ModeOptions& options) const;
  std::optional<HarmonicModes> converged(HarmonicModes modes, int most) const;
  int most_affordable() const;
  void complete(const ModeOptions& options, HarmonicModes& modes) const;
  void add_shift(HarmonicModes& result) const;
  bool is_complete(const HarmonicModes& modes) const;
  bool is_phase(std::complex<double> s, const HarmonicSizes& sizes) const;
  bool take(Modes found, const ModeOptions& options, HarmonicModes& result) const;

  const PeriodicEquations& equations_;
  HarmonicShapes shapes_;
  std::unique_ptr<const HarmonicSearch> mean_;
};

}  // namespace bielle::mechanism
