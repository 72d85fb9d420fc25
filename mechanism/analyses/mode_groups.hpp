// Parts by which modes are named: entries of the model with inertia, those whose names differ by numbers alone
// together.
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/modes.hpp"

namespace bielle::mechanism {

/// Entries with a common name.
struct ModeGroup {
  std::string name;                     ///< "tower"; of several entries without their numbers: "blade"
  std::vector<std::vector<int>> nodes;  ///< nodes of each entry, in the order of its members
  bool flexible = false;                ///< whether an entry can deform
  VectorX kinetic, turning;             ///< kinetic energy in each mode, and its part by rotations of nodes [J]
  VectorX energy;                       ///< sum of kinetic and |potential| energy in each mode [J]
  VectorX deformation;                  ///< energy of deformation in each mode [J]
  VectorX extension, torsion;           ///< of slender members, in each mode [J]
  VectorX bending_y, bending_z;         ///< about the axes of the section
  VectorX flap, edge;                   ///< about the softer and the stiffer axis of the section, where they differ
};

/// Returns the groups with kinetic energy in some mode.
std::vector<ModeGroup> mode_groups(const System& system, const ModesReport& report);

/// Returns a name with a star in place of each number: "blade_*.blade".
std::string with_stars(const std::string& name);

/// Returns a name with stars without them, and without words that repeat: "blade". If nothing is left, it is the name.
std::string short_name(const std::string& starred);

}  // namespace bielle::mechanism
