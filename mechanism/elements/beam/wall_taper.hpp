// Sections of walls along a taper, from a few solutions of Saint-Venant's problems.
//
// Between two ends whose dimensions vary linearly, J, the shear compliance, the shear centre and the shear stresses at
// moving points are smooth functions of the position s along the beam. They are interpolated, in dimensionless form
// (log J, A F, s/r, A tau and J r/A tau, with area A and radius of gyration r), by polynomials through Chebyshev
// points, whose number is doubled until the previous polynomial is accurate to 3e-3 at the new points: because of its
// geometric convergence the new one is then accurate to some 1e-5, less than the error of the finite elements. If 33
// points are not sufficient (a wall that nearly vanishes), each section is solved separately.
#pragma once

#include <vector>

#include "mechanism/elements/beam/section_shape.hpp"

namespace bielle::mechanism {

/// Results of the finite elements for a section.
struct SectionValues {
  SectionConstants constants;
  std::vector<UnitShearStress> shear_stress;  ///< at the stress points
};

/// @param points  y and z of each stress point, relative to the centroid [m]
SectionValues section_values(const SectionShape& shape, const VectorX& points);

class WallTaper {
 public:
  /// @param shape   i, t, l or box
  /// @param start,end  dimensions
  /// @param points_start,points_end  stress points at both ends; they are inside of the section along the whole beam
  WallTaper(std::string shape, VectorX start, VectorX end, VectorX points_start, VectorX points_end);

  SectionValues at(double s) const;
  int solutions() const { return static_cast<int>(nodes_.size()); }  ///< used; 0: none is shared

 private:
  SectionValues solve(double s) const;
  VectorX numbers(double s) const;  ///< dimensionless values at s
  VectorX interpolated(double s) const;

  std::string shape_;
  VectorX start_, end_, points_start_, points_end_;
  std::vector<double> nodes_;
  std::vector<VectorX> values_;
};

}  // namespace bielle::mechanism
