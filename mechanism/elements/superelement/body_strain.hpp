// Strains of a superelement at places distributed over it, of all kinds: stretch, shear, bending, torsion.
//
// The size of a strain with the principal values e1 >= e2 >= e3 is the largest of |e1|, |e3| and two thirds of the
// largest shear, e1 - e3: it is e for a bar that is stretched by e, and 2/3 gamma for a bar that is sheared by gamma.
// The mean over the body contains the strains that do not cancel, stretch and uniform shear: the error of linear
// elasticity is of first order in this mean.
//
// Files without strains (`/reduced/strain`) give no estimate, because bending shortens the distance of two interfaces
// without strain.
#pragma once

#include "mechanism/elements/superelement/superelement_body_matrices.hpp"

namespace bielle::mechanism {

/// Sizes of strain, as defined above.
struct StrainSizes {
  double largest = 0;  ///< largest over all places
  double mean = 0;     ///< size of the mean strain
};

class BodyStrain {
 public:
  BodyStrain() = default;
  /// @param matrices  must outlive this object
  explicit BodyStrain(const SuperelementMatrices& matrices);
  /// @param eps  linear coordinates
  StrainSizes calc(const VectorX& eps) const;

 private:
  const MatrixX* strains_ = nullptr;  ///< strains of the matrices; nullptr: not known
};

}  // namespace bielle::mechanism
