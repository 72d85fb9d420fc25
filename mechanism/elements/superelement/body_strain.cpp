#include "mechanism/elements/superelement/body_strain.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/elements/superelement/recovery/stress_invariants.hpp"

namespace bielle::mechanism {
namespace {

double size_of(const double* strain) {
  const Vector3 e = principal_values(strain, 0.5);
  return std::max({std::abs(e[0]), std::abs(e[2]), 2.0 / 3 * (e[0] - e[2])});
}

/// Returns the square of the tensor's norm. The norm is an upper bound of all principal values and of 2/3 of their
/// differences.
double square_norm(const double* strain) {
  const Eigen::Map<const Vector3> stretch(strain), shear(strain + 3);
  return stretch.squaredNorm() + 0.5 * shear.squaredNorm();
}

}  // namespace

BodyStrain::BodyStrain(const SuperelementMatrices& matrices) {
  if (matrices.strains.size() > 0) strains_ = &matrices.strains;
}

StrainSizes BodyStrain::calc(const VectorX& eps) const {
  StrainSizes sizes;
  if (!strains_) return sizes;
  thread_local VectorX strain;
  strain.noalias() = *strains_ * eps;
  const Eigen::Index last = strain.size() - 6;
  for (Eigen::Index k = 0; k < last; k += 6)
    if (square_norm(strain.data() + k) > sizes.largest * sizes.largest)
      sizes.largest = std::max(sizes.largest, size_of(strain.data() + k));
  sizes.mean = size_of(strain.data() + last);
  return sizes;
}

}  // namespace bielle::mechanism
