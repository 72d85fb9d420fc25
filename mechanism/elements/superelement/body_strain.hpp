// Strains of a superelement, by all measures of strain at places distributed over it: stretch, shear, bending, torsion.
//
// A strain with the principal values e1 >= e2 >= e3 has as its size the largest of |e1|, |e3| and two thirds of the
// largest shear, e1 - e3: a bar that is stretched by e has the size e, one that is sheared by gamma has 2/3 gamma. The
// mean over the body contains the strains that do not cancel, stretch and uniform shear: linear elasticity has an error
// of first order in it.
//
// Files without strains (`/reduced/strain`) give no estimate: the line between two interfaces becomes shorter by
// bending, without strain.
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
