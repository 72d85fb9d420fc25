// Interface of slender components: how a small motion bends, twists and stretches them.
#pragma once

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

/// Strain energies of a small motion by kinds of deformation [J]. A part may be negative if a section couples them.
struct StrainEnergies {
  double extension = 0, torsion = 0;
  double bending_y = 0, bending_z = 0;  ///< about the axes of the section, with the shear that belongs to them
};

class SlenderComponent {
 public:
  virtual ~SlenderComponent() = default;
  /// Returns the energies of the linear law at the strains of a variation of the positions.
  /// @param du  (12) displacement [m], inertial, and rotation vector [rad], node axes, of each of two nodes
  virtual StrainEnergies strain_energies(const LocalState& state, const Eigen::Ref<const VectorX>& du) const = 0;
  /// Returns the axis of the section about which the component bends more easily, 1 (y) or 2 (z); 0 if it bends as
  /// easily about both.
  virtual int softer_axis() const = 0;
};

}  // namespace bielle::mechanism
