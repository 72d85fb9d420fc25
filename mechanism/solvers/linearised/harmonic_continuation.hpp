// Modes of periodic equations with more harmonics, from those with fewer, by inverse iteration.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/solvers/linearised/harmonic_shapes.hpp"
#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

/// Dependence of the coefficients on the azimuth of the turning part, the simplest first.
enum class Periodicity {
  negligible,  ///< the rate is negligible compared with all frequencies: the equations are those at rest
  constant,    ///< constant in axes that turn with the part
  multiblade,  ///< constant in multiblade coordinates: one harmonic is exact
  periodic     ///< periodic in any coordinates
};

struct HarmonicMode {
  Mode mode;              ///< its shapes are those of the harmonics
  Eigen::MatrixXcd u, w;  ///< amplitudes at harmonics -h .. h (columns)
  double whirl = 0;       ///< sense (HarmonicShapes::whirl)
};

struct HarmonicModes {
  Periodicity periodicity = Periodicity::constant;
  int harmonics = 0;              ///< h
  double change = 0;              ///< largest change of an exponent by more harmonics or smaller steps, relative
  LinearisedEquations equations;  ///< equations of the harmonics
  std::vector<HarmonicMode> modes;
  bool all = false;                      ///< there are no others
  int states = 0;                        ///< number of states at one azimuth
  std::optional<int> growing_besides{};  ///< as in `Modes`
  /// Number of harmonics with which the motions about a periodic motion could not be told apart; the modes are those
  /// of the mean equations. 0: the modes are about the periodic motion.
  int unresolved = 0;

  /// Returns the modes without their amplitudes.
  Modes found() const;
};

void sort_by_rate(std::vector<HarmonicMode>& modes);  ///< |s| ascending

/// Returns the amplitudes with zeros for further harmonics.
Eigen::MatrixXcd widened(const Eigen::MatrixXcd& amplitudes, int h);

/// Returns the amplitudes of the copy of a motion whose exponent is larger by a multiple of i rate: those of harmonic
/// k + multiple at k, without those beyond the last one.
Eigen::MatrixXcd copied(const Eigen::MatrixXcd& amplitudes, int multiple);

/// Takes the copy of a motion whose exponent is larger by a multiple of i rate, or its conjugate, with Im s >= 0.
/// @param u,w  amplitudes
void take_copy(int multiple, double rate, std::complex<double>& s, Eigen::MatrixXcd& u, Eigen::MatrixXcd& w);

/// Whether a motion is one of the modes, or a copy of one. @param u  as many harmonics as they have @param s  exponent
bool is_among(const HarmonicShapes& shapes, const HarmonicModes& modes, const Eigen::MatrixXcd& u,
              std::complex<double> s);

/// Exponents that represent a motion: those of the largest harmonic (harmonic_shapes.hpp), or those into which the
/// exponents go over that are continued.
enum class Copies { largest, continued };

/// @param from  modes with fewer harmonics, or of equations that differ a little
/// @returns modes with their changes by the further harmonics; nothing if two become the same one, or the shift in
/// time, or, of continued exponents, if a shape has become another one
std::optional<HarmonicModes> continue_modes(const PeriodicEquations& equations, const HarmonicShapes& shapes,
                                            const HarmonicModes& from, int harmonics, Copies copies);

/// Whether the modes satisfy the equations with one more harmonic, which shows that they are exact. One factorisation
/// at a real shift serves all modes. Rounding of very stiff equations may hide it.
/// @param exact  largest change of an exponent by one inverse iteration, relative to the exponent and the rate; a shape
/// may change by 1e-5
bool are_exact(const PeriodicEquations& equations, const HarmonicModes& modes, double exact);

/// Sets the kind and the uncertainty of modes that were continued. @param options  those of the search
void judge_modes(HarmonicModes& modes, const ModeOptions& options);

}  // namespace bielle::mechanism
