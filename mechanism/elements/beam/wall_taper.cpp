#include "mechanism/elements/beam/wall_taper.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/LU>

namespace bielle::mechanism {
namespace {

double radius_of_gyration(const RectangleArea& area) { return std::sqrt(area.I.trace() / area.area); }

/// Returns the k-th Chebyshev point of degree n on [0, 1]. Every second one is of degree n/2.
double chebyshev_point(int k, int n) { return 0.5 * (1 - std::cos(std::numbers::pi * k / n)); }

}  // namespace

SectionValues section_values(const SectionShape& shape, const VectorX& points) {
  SectionValues values{shape.constants(), {}};
  for (Eigen::Index p = 0; p < points.size(); p += 2)
    values.shear_stress.push_back(shape.shear_stress(points.segment<2>(p)));
  return values;
}

WallTaper::WallTaper(std::string shape, VectorX start, VectorX end, VectorX points_start, VectorX points_end)
    : shape_(std::move(shape)),
      start_(std::move(start)),
      end_(std::move(end)),
      points_start_(std::move(points_start)),
      points_end_(std::move(points_end)) {
  constexpr int first = 4, most = 32;
  constexpr double enough = 3e-3;
  for (int n = first; n <= most; n *= 2) {
    std::vector<double> nodes;
    std::vector<VectorX> values;
    double error = n == first ? INFINITY : 0;
    for (int k = 0; k <= n; ++k) {
      nodes.push_back(chebyshev_point(k, n));
      if (n > first && k % 2 == 0) {
        values.push_back(values_[static_cast<std::size_t>(k / 2)]);
        continue;
      }
      values.push_back(numbers(nodes.back()));
      if (n == first) continue;
      const VectorX difference = interpolated(nodes.back()) - values.back();
      error = std::max(error, (difference.array().abs() / values.back().array().abs().max(1.0)).maxCoeff());
    }
    nodes_ = std::move(nodes);
    values_ = std::move(values);
    if (error < enough) return;
  }
  nodes_.clear();
  values_.clear();
}

SectionValues WallTaper::solve(double s) const {
  return section_values(*make_section_shape(shape_, (1 - s) * start_ + s * end_),
                        (1 - s) * points_start_ + s * points_end_);
}

VectorX WallTaper::numbers(double s) const {
  const SectionValues values = solve(s);
  const SectionConstants& k = values.constants;
  const double r = std::sqrt((k.I_y + k.I_z) / k.A);
  VectorX all(6 + 6 * static_cast<Eigen::Index>(values.shear_stress.size()));
  const Matrix2 compliance = k.A * k.shear_area.inverse();
  all.head<6>() << std::log(k.J), compliance(0, 0), compliance(0, 1), compliance(1, 1), k.shear_centre / r;
  Eigen::Index at = 6;
  for (const UnitShearStress& tau : values.shear_stress) {
    all.segment<6>(at) = (tau * Vector3(k.A, k.A, k.J * r / k.A).asDiagonal()).reshaped();
    at += 6;
  }
  return all;
}

VectorX WallTaper::interpolated(double s) const {
  VectorX sum = VectorX::Zero(values_.front().size());
  double weights = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (s == nodes_[k]) return values_[k];
    const double end = k == 0 || k + 1 == nodes_.size() ? 0.5 : 1.0;
    const double weight = (k % 2 ? -end : end) / (s - nodes_[k]);
    sum += weight * values_[k];
    weights += weight;
  }
  return sum / weights;
}

SectionValues WallTaper::at(double s) const {
  if (nodes_.empty()) return solve(s);
  const VectorX all = interpolated(s);
  const RectangleArea area = wall_area(shape_, (1 - s) * start_ + s * end_);
  const double r = radius_of_gyration(area);
  Matrix2 compliance;
  compliance << all[1], all[2], all[2], all[3];
  SectionValues values;
  values.constants = {area.area,
                      area.I(1, 1),
                      area.I(0, 0),
                      area.I(0, 1),
                      std::exp(all[0]),
                      area.area * compliance.inverse(),
                      r * all.segment<2>(4)};
  const Vector3 scale(area.area, area.area, values.constants.J * r / area.area);
  for (Eigen::Index at = 6; at < all.size(); at += 6)
    values.shear_stress.push_back(all.segment<6>(at).reshaped(2, 3) * scale.cwiseInverse().asDiagonal());
  return values;
}

}  // namespace bielle::mechanism
