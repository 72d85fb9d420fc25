// Names of modes in the words of designers: "1st tower fore-aft", "2nd blade flap, backward", "bob about pivot".
//
// A name consists of the part with most energy, its motion (mode_motion.hpp), and the pattern of blades or the sense of
// whirl. A name omits each of these that has less than 60 % of the energy or of the motion. Modes of one name are
// numbered by rising frequency. The shapes of modes of equal frequency are arbitrary within their space, and do not
// enter the name: these modes have one number and are counted as "1 of 2".
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "mechanism/analyses/modes.hpp"

namespace bielle::mechanism {

/// The parts of a name.
struct ModeName {
  std::string part;     ///< "tower"; empty if no entry of the mode has inertia
  std::string family;   ///< of the motion: "bending"
  std::string motion;   ///< "bending about y"
  std::string pattern;  ///< "collective"
  /// Whether the first mode of a name is called "1st": parts that can deform have more than one.
  bool numbered = false;
  int copies = 1;          ///< number of blades with patterns, and of modes of each order
  std::complex<double> s;  ///< exponent by which equal modes are recognised [1/s]
  ModeKind kind = ModeKind::oscillating;
  double rate = 0;  ///< rate by which modes of one name are numbered [1/s]
};

/// Describes each mode of a report, by its energies.
std::vector<ModeName> describe_modes(const System& system, const ModesReport& report);

/// Returns a different name for each mode, or an empty one for a mode without a part.
/// @param from_slowest  whether these are the slowest modes; otherwise their numbers are unknown, and modes of equal
/// name are distinguished by their frequencies
std::vector<std::string> full_names(std::vector<ModeName> modes, bool from_slowest = true);

}  // namespace bielle::mechanism
