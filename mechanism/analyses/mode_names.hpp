// Names of modes as designers say them: "1st tower fore-aft", "2nd blade flap, backward", "bob about pivot".
//
// A name has the part with most energy, its motion (mode_motion.hpp), and the pattern of blades or the sense of whirl.
// Each of them is left out if less than 60 % of the energy or of the motion is in it. Modes of one name are numbered by
// rising frequency. Modes of one frequency have arbitrary shapes within a space, by which they are not named: they have
// one number, and count as "1 of 2".
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "mechanism/analyses/modes.hpp"

namespace bielle::mechanism {

/// The parts of a name.
struct ModeName {
  std::string part;        ///< "tower"; empty if no entry of the mode has inertia
  std::string family;      ///< of the motion: "bending"
  std::string motion;      ///< "bending about y"
  std::string pattern;     ///< "collective"
  bool numbered = false;   ///< whether the first of them is called so: parts that can deform have more
  int copies = 1;          ///< number of blades that have patterns: each order has as many modes
  std::complex<double> s;  ///< exponent by which equal modes are recognised [1/s]
  ModeKind kind = ModeKind::oscillating;
  double rate = 0;  ///< rate by which modes of one name are numbered [1/s]
};

/// Describes each mode of a report with its energies.
std::vector<ModeName> describe_modes(const System& system, const ModesReport& report);

/// Returns a different name for each mode, empty for a mode without a part.
/// @param from_slowest  whether there are no slower modes than these; otherwise their numbers are not known, and those
/// of one name have their frequency in it
std::vector<std::string> full_names(std::vector<ModeName> modes, bool from_slowest = true);

}  // namespace bielle::mechanism
