// How far a superelement is strained, by all measures of strain at places spread over it: stretch, shear, bending,
// torsion.
//
// A strain with the principal values e1 >= e2 >= e3 has as its size the largest of |e1|, |e3| and two thirds of the
// largest shear, e1 - e3: a bar that is stretched by e has the size e, one that is sheared by gamma 2/3 gamma. The mean
// over the body is what does not cancel, stretch and uniform shear: by it linear elasticity is wrong to the first
// order.
//
// Files without strains (`/reduced/strain`) have the stretch of the lines between their interfaces alone.
#pragma once

#include <vector>

#include "mechanism/elements/superelement/superelement_body_matrices.hpp"

namespace bielle::mechanism {

/// Sizes of strain, as above.
struct StrainSizes {
  double largest = 0;  ///< of all places
  double mean = 0;     ///< of the mean strain
};

class BodyStrain {
 public:
  BodyStrain() = default;
  /// @param matrices  kept as long as this is @param points  interfaces, as placed
  BodyStrain(const SuperelementMatrices& matrices, const std::vector<BodyPoint>& points);
  /// @param eps  linear coordinates
  StrainSizes calc(const VectorX& eps) const;

 private:
  struct Line {
    int from, to;        ///< rows of the interfaces' displacements
    Vector3 per_length;  ///< direction over length [1/m]
  };
  const MatrixX* strains_ = nullptr;  ///< of the matrices
  std::vector<Line> lines_;
};

}  // namespace bielle::mechanism
