#include "mechanism/math/curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/math/gauss.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

Curve::Curve(const Eigen::Ref<const MatrixX>& points, bool closed, const std::string& name)
    : closed_(closed), knots_{0}, lengths_{0} {
  const Eigen::Index given = points.rows(), n = given + (closed ? 1 : 0);
  if (given < (closed ? 3 : 2))
    throw InputError(fmt::format("{}: a curve needs {} points", name, closed ? "three" : "two"));
  MatrixX all(n, 3);
  all.topRows(given) = points;
  if (closed) all.row(given) = points.row(0);
  for (Eigen::Index k = 1; k < n; ++k) {
    const double way = (all.row(k) - all.row(k - 1)).norm();
    if (!(way > 0))
      throw InputError(closed && k == given ? fmt::format("{}: a closed curve does not repeat its first point", name)
                                            : fmt::format("{}: points {} and {} coincide", name, k, k + 1));
    knots_.push_back(knots_.back() + way);
  }
  const VectorX u = Eigen::Map<const VectorX>(knots_.data(), n);
  for (int axis = 0; axis < 3; ++axis)
    coordinates_.emplace_back(u, VectorX(all.col(axis)),
                              closed ? Interpolation::Kind::periodic : Interpolation::Kind::cubic, name);
  for (std::size_t k = 1; k < knots_.size(); ++k)
    lengths_.push_back(lengths_.back() + length_within(knots_[k - 1], knots_[k]));
}

Curve::Place Curve::operator()(double u) const {
  const double inside = closed_ ? u : std::clamp(u, 0.0, end());
  Place place;
  for (int axis = 0; axis < 3; ++axis) {
    const Interpolation::Values values = coordinates_[static_cast<std::size_t>(axis)](inside);
    place.point[axis] = values.value;
    place.first[axis] = values.slope;
    place.second[axis] = values.curvature;
  }
  if (inside != u) {
    place.point += (u - inside) * place.first;
    place.second.setZero();
  }
  return place;
}

double Curve::length_within(double from, double to) const {
  constexpr int parts = 16;  // quadrature of sixth order: error of 1e-12 of a piece that bends by half a radian
  const double h = (to - from) / parts;
  double length = 0;
  for (int part = 0; part < parts; ++part)
    for (std::size_t g = 0; g < Gauss3::place.size(); ++g)
      length += Gauss3::weight[g] * h * (*this)(from + h * (part + Gauss3::place[g])).first.norm();
  return length;
}

double Curve::arc_length(double u) const {
  const double rounds = closed_ ? std::floor(u / end()) : 0, within = u - rounds * end();
  if (!closed_ && within > end()) return lengths_.back() + (within - end()) * (*this)(end()).first.norm();
  if (!closed_ && within < 0) return within * (*this)(0).first.norm();
  const auto next = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, within);
  const auto k = static_cast<std::size_t>(next - knots_.begin()) - 1;
  return rounds * lengths_.back() + lengths_[k] + length_within(knots_[k], within);
}

double Curve::nearest(const Vector3& point) const {
  // The closest of some sample points on each piece is the initial guess of Newton's method on (point - c) . c' = 0.
  constexpr int samples = 8;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k)
    for (int j = 0; j <= samples; ++j) {
      const double u = knots_[k] + (knots_[k + 1] - knots_[k]) * j / samples;
      if (const double far = ((*this)(u).point - point).squaredNorm(); far < least) {
        least = far;
        best = u;
      }
    }
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Place c = (*this)(best);
    const Vector3 way = point - c.point;
    const double slope = c.first.squaredNorm() - way.dot(c.second);
    if (!(slope > 0)) break;
    const double step = way.dot(c.first) / slope;
    best += step;
    if (!closed_) best = std::clamp(best, 0.0, end());
    if (std::abs(step) <= 1e-15 * end()) break;
  }
  return best;
}

}  // namespace bielle::mechanism
