#include "mechanism/joints/tyres/road_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bielle::mechanism {

RoadProfile::RoadProfile(const Eigen::Ref<const MatrixX>& table, const std::string& name)
    : heights_(table.col(0), table.col(1), Interpolation::Kind::cubic, name) {
  for (const double x : heights_.points()) curvatures_.push_back(heights_(x).curvature);
}

RoadProfile::Values RoadProfile::operator()(double x) const {
  const auto points = heights_.points();
  if (const double end = std::clamp(x, points.front(), points.back()); end != x) {
    const Interpolation::Values at = heights_(end);
    return {at.value + at.slope * (x - end), at.slope, 0, 0};
  }
  const auto above = std::upper_bound(points.begin(), points.end(), x);
  const auto k =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - points.begin(), 1, std::ssize(points) - 1));
  const Interpolation::Values at = heights_(x);
  return {at.value, at.slope, at.curvature, (curvatures_[k] - curvatures_[k - 1]) / (points[k] - points[k - 1])};
}

// The nearest point is sought among the points of the table within reach and places between them, and then by Newton's
// method for (x - s) + (z - f) f' = 0, which bisection safeguards.
double RoadProfile::nearest(double x, double z, double reach) const {
  constexpr int least_parts = 16;
  const auto points = heights_.points();
  const auto squared = [&](double s) {
    const double dz = z - (*this)(s).height;
    return (x - s) * (x - s) + dz * dz;
  };
  double best = x, least = squared(x), width = 2 * reach / least_parts;
  const auto offer = [&](double s) {
    if (const double d = squared(s); d < least) {
      least = d;
      best = s;
    }
  };
  for (int k = 0; k <= least_parts; ++k) offer(x - reach + k * width);
  const auto first = std::lower_bound(points.begin(), points.end(), x - reach);
  for (auto each = first; each != points.end() && *each <= x + reach; ++each) offer(*each);
  double low = std::max(x - reach, best - width), high = std::min(x + reach, best + width);
  double s = best;
  constexpr int most_steps = 60;
  for (int k = 0; k < most_steps; ++k) {
    const Values at = (*this)(s);
    const double dz = z - at.height, G = (x - s) + dz * at.slope;
    const double D = 1 + at.slope * at.slope - dz * at.curvature;
    (G > 0 ? low : high) = s;
    const double next = s + G / D;
    const double step = D > 0 && next >= low && next <= high ? next : 0.5 * (low + high);
    if (std::abs(step - s) <= 1e-15 * (reach + std::abs(s))) return step;
    s = step;
  }
  return s;
}

// With G(s, x, z) = (x - s) + (z - f(s)) f'(s) = 0 and D = -dG/ds, the derivatives of s(x, z) are
//     s_x = 1/D,   s_z = f'/D,   s_xx = G_ss s_x^2/D,   s_xz = (G_ss s_x s_z + f'' s_x)/D,
//     s_zz = (G_ss s_z^2 + 2 f'' s_z)/D,   G_ss = -3 f' f'' + (z - f) f'''.
template <int order>
RoadProfile::Foot<order> RoadProfile::foot(const PairMeasureOf<order>& x, const PairMeasureOf<order>& z,
                                           double reach) const {
  const double at = nearest(x.value, z.value, reach);
  const auto [f, f1, f2, f3] = (*this)(at);
  const double D = 1 + f1 * f1 - (z.value - f) * f2, G_ss = -3 * f1 * f2 + (z.value - f) * f3;
  const double s_x = 1 / D, s_z = f1 / D;
  const auto s = compose(x, z, at, s_x, s_z, G_ss * s_x * s_x / D, (G_ss * s_x * s_z + f2 * s_x) / D,
                         (G_ss * s_z * s_z + 2 * f2 * s_z) / D);
  const auto slope = compose(s, f1, f2, f3), root = sqrt(square(slope) + 1.0);
  Foot<order> foot;
  foot.normal_x = -(slope / root);
  foot.normal_z = PairMeasureOf<order>(1.0) / root;
  foot.distance = foot.normal_x * (x - s) + foot.normal_z * (z - compose(s, f, f1, f2));
  return foot;
}

template RoadProfile::Foot<1> RoadProfile::foot<1>(const PairSlope&, const PairSlope&, double) const;
template RoadProfile::Foot<2> RoadProfile::foot<2>(const PairMeasure&, const PairMeasure&, double) const;

RoadProfile::Valley RoadProfile::tightest_valley() const {
  constexpr int parts = 8;
  const auto points = heights_.points();
  Valley valley{points.front(), std::numeric_limits<double>::infinity()};
  for (std::size_t k = 1; k < points.size(); ++k)
    for (int j = 0; j <= parts; ++j) {
      const double x = points[k - 1] + (points[k] - points[k - 1]) * j / parts;
      const Values at = (*this)(x);
      if (!(at.curvature > 0)) continue;
      const double radius = std::pow(1 + at.slope * at.slope, 1.5) / at.curvature;
      if (radius < valley.radius) valley = {x, radius};
    }
  return valley;
}

std::vector<std::vector<double>> RoadProfile::line() const {
  constexpr int pieces = 400;
  const auto points = heights_.points();
  std::vector<std::vector<double>> line;
  for (int k = 0; k <= pieces; ++k) {
    const double x = points.front() + (points.back() - points.front()) * k / pieces;
    line.push_back({x, 0, (*this)(x).height});
  }
  return line;
}

}  // namespace bielle::mechanism
