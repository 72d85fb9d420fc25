// How far a superelement is strained, by all measures of strain at places spread over it: stretch, shear, bending,
// torsion.
//
// A strain with the principal values e1 >= e2 >= e3 has as its size the largest of |e1|, |e3| and two thirds of the
// largest shear, e1 - e3: a bar that is stretched by e has the size e, one that is sheared by gamma 2/3 gamma. The mean
// over the body is what does not cancel, stretch and uniform shear: by it linear elasticity is wrong to the first
// order.
//
// Files without strains (`/reduced/strain`) tell nothing: the line between two interfaces becomes shorter where a body
// bends, without strain.
#pragma once

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
  /// @param matrices  kept as long as this is
  explicit BodyStrain(const SuperelementMatrices& matrices);
  /// @param eps  linear coordinates
  StrainSizes calc(const VectorX& eps) const;

 private:
  const MatrixX* strains_ = nullptr;  ///< of the matrices; nullptr: not known
};

}  // namespace bielle::mechanism
