// Parts by which modes are named. A part is an entry of the model with inertia; entries whose names differ in numbers
// only form one part.
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/modes.hpp"

namespace bielle::mechanism {

/// Entries with a common name.
struct ModeGroup {
  std::string name;                     ///< "tower"; for several entries the name without numbers: "blade"
  std::vector<std::vector<int>> nodes;  ///< nodes of each entry, in the order of its members
  bool flexible = false;                ///< whether an entry can deform
  /// Kinetic energy in each mode, and the part of it due to rotations of nodes [J].
  VectorX kinetic, turning;
  VectorX energy;                ///< sum of kinetic and |potential| energy in each mode [J]
  VectorX deformation;           ///< energy of deformation in each mode [J]
  VectorX extension, torsion;    ///< elastic energy of slender members in each mode [J]
  VectorX bending_y, bending_z;  ///< about the axes of the section
  /// Energy of bending about the softer and the stiffer axis of the section, if these differ [J].
  VectorX flap, edge;
};

/// Returns the groups with kinetic energy in some mode.
std::vector<ModeGroup> mode_groups(const System& system, const ModesReport& report);

/// Returns a name with a star in place of each number: "blade_*.blade".
std::string with_stars(const std::string& name);

/// Removes the stars and repeated words from a name: "blade". If nothing is left, it returns the name itself.
std::string short_name(const std::string& starred);

}  // namespace bielle::mechanism
