// Scalars of a stress or strain at a point, six components in the order xx yy zz yz xz xy.
#pragma once

#include <cmath>

#include <Eigen/Eigenvalues>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Returns sqrt(((sxx-syy)^2 + (syy-szz)^2 + (szz-sxx)^2)/2 + 3 (syz^2 + sxz^2 + sxy^2)).
/// @param s  (6)
inline double von_mises(const double* s) {
  const double normal = (s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) + (s[2] - s[0]) * (s[2] - s[0]);
  return std::sqrt(0.5 * normal + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// Returns the principal values, the largest first.
/// @param shear  1 for stress; 1/2 for strain, whose shears are engineering shears
inline Vector3 principal_values(const double* s, double shear = 1) {
  Matrix3 tensor;  // the solver reads the lower half
  tensor << s[0], 0, 0, shear * s[5], s[1], 0, shear * s[4], shear * s[3], s[2];
  // The iterative solver is used: the closed form loses half of the digits if two of the values are equal, as in plain
  // tension.
  return Eigen::SelfAdjointEigenSolver<Matrix3>(tensor, Eigen::EigenvaluesOnly).eigenvalues().reverse();
}

}  // namespace bielle::mechanism
