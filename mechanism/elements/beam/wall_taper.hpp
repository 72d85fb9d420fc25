// Sections of walls along a taper, from a few solutions of Saint-Venant's problems.
//
// Between two ends whose dimensions vary linearly, J, the shear compliance, the shear centre and the shear stresses at
// moving points are smooth functions of the place s along the beam. They are interpolated, without dimensions (log J, A
// F, s/r, A tau and J r/A tau, with area A and radius of gyration r), by polynomials through Chebyshev's points, whose
// number is doubled until the former polynomial is right to 3e-3 at the new points: by its geometric convergence the
// new one is then right to some 1e-5, less than the error of the finite elements. Where 33 points do not suffice (a
// wall that nearly vanishes) each section is solved separately.
#pragma once

#include <vector>

#include "mechanism/elements/beam/section_shape.hpp"

namespace bielle::mechanism {

/// What finite elements give of a section.
struct SectionValues {
  SectionConstants constants;
  std::vector<UnitShearStress> shear_stress;  ///< at the stress points
};

/// @param points  y and z of each stress point, from the centroid [m]
SectionValues section_values(const SectionShape& shape, const VectorX& points);

class WallTaper {
 public:
  /// @param shape   i, t, l or box
  /// @param start,end  dimensions
  /// @param points_start,points_end  of the stress points, inside of the section all along
  WallTaper(std::string shape, VectorX start, VectorX end, VectorX points_start, VectorX points_end);

  SectionValues at(double s) const;
  int solutions() const { return static_cast<int>(nodes_.size()); }  ///< that it rests on; 0: each section its own

 private:
  SectionValues solve(double s) const;
  VectorX numbers(double s) const;  ///< of a solution, without dimensions
  VectorX interpolated(double s) const;

  std::string shape_;
  VectorX start_, end_, points_start_, points_end_;
  std::vector<double> nodes_;
  std::vector<VectorX> values_;
};

}  // namespace bielle::mechanism
