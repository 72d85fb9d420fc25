#include "mechanism/elements/superelement/body_strain.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/elements/superelement/recovery/stress_invariants.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::size_t most_ends = 12;  // interfaces between which lines are looked at

double size_of(const double* strain) {
  const Vector3 e = principal_values(strain, 0.5);
  return std::max({std::abs(e[0]), std::abs(e[2]), 2.0 / 3 * (e[0] - e[2])});
}

}  // namespace

BodyStrain::BodyStrain(const SuperelementMatrices& matrices, const std::vector<BodyPoint>& points) {
  if (matrices.strains.size() > 0) {
    strains_ = &matrices.strains;
    return;
  }
  const std::size_t count = std::min(points.size(), most_ends);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Vector3 line = points[i].X - points[k].X;
      if (points[i].keeps_position && points[k].keeps_position &&
          line.norm() > coincident_interfaces * matrices.gyration)
        lines_.push_back({points[k].u, points[i].u, line / line.squaredNorm()});
    }
}

StrainSizes BodyStrain::calc(const VectorX& eps) const {
  StrainSizes sizes;
  for (const Line& line : lines_)
    sizes.mean =
        std::max(sizes.mean, std::abs(line.per_length.dot(eps.segment<3>(line.to) - eps.segment<3>(line.from))));
  sizes.largest = sizes.mean;
  if (!strains_) return sizes;
  thread_local VectorX strain;
  strain.noalias() = *strains_ * eps;
  const Eigen::Index last = strain.size() - 6;
  for (Eigen::Index k = 0; k < last; k += 6) sizes.largest = std::max(sizes.largest, size_of(strain.data() + k));
  sizes.mean = size_of(strain.data() + last);
  return sizes;
}

}  // namespace bielle::mechanism
