// The place of a cylinder's end that is nearest to something convex.
//
// A cylinder's end is the half of a very flat spheroid, x = c + M w, |w| = 1: M = [R a_1, R a_2, h a_3] with the
// cylinder's axes a, its core's radius R and h = 0.01 R (less where the core is thinner). As this is strictly convex,
// one place of it is the nearest, and moves smoothly, also where the end lies flat on a face: from its middle to its
// rim, within 0.02 rad of tilt. It is within the exact end by at most h.
//
// With d(x) the distance from something convex and n its direction, w is the minimum of d on the sphere,
//     M^T n + lambda w = 0,   lambda > 0,
// found by Newton's method on the sphere with a line search: of d, which is convex, no other place is stationary with
// lambda > 0. Derivatives follow from one more step of it in numbers that carry them.
#pragma once

#include <array>
#include <cmath>

#include "mechanism/contacts/point_distances.hpp"

namespace bielle::mechanism {

template <class T>
struct PlacedDisc {
  Triple<T> middle;
  std::array<Triple<T>, 3> half_axes;  ///< columns of M
  Triple<T> at(const Triple<T>& w) const {
    return middle + w.x * half_axes[0] + w.y * half_axes[1] + w.z * half_axes[2];
  }
  /// M^T n
  Triple<T> along(const Triple<T>& n) const {
    return {dot(half_axes[0], n), dot(half_axes[1], n), dot(half_axes[2], n)};
  }
};

template <class T>
PlacedDisc<T> disc_of(const PlacedShape<T>& cylinder, std::size_t end) {
  const ContactShape& shape = *cylinder.shape;
  return {point_of(cylinder, shape.corners()[end]),
          {T(shape.dome_radius()) * cylinder.axes[0], T(shape.dome_radius()) * cylinder.axes[1],
           T(shape.dome_height()) * cylinder.axes[2]}};
}

/// The equation of the nearest place at w, in values.
struct DiscEquation {
  Vector3 g;     ///< M^T n
  Matrix3 bend;  ///< M^T (dn/dx) M
};

template <class T, class Target>
DiscEquation disc_equation(const PlacedDisc<T>& disc, const Vector3& w, const Target& target) {
  using Three = AutoDiff<3, 1>;
  Triple<Three> x(value_of(disc.at(Triple<T>(w))));
  Matrix3 M;
  for (int k = 0; k < 3; ++k) M.col(k) = value_of(disc.half_axes[static_cast<std::size_t>(k)]);
  x.x.gradient = Vector3::UnitX();
  x.y.gradient = Vector3::UnitY();
  x.z.gradient = Vector3::UnitZ();
  const Triple<Three> n = target.template still<Three>().from(x).normal;
  Matrix3 dn;
  dn << n.x.gradient.transpose(), n.y.gradient.transpose(), n.z.gradient.transpose();
  const Matrix3 dn_M = dn * M;
  return {M.transpose() * value_of(n), M.transpose() * dn_M};
}

/// Newton's step along the sphere.
inline Vector3 step_on_disc(const DiscEquation& at, const Vector3& w) {
  const Matrix3 across = Matrix3::Identity() - w * w.transpose();
  const double against = -at.g.dot(w), lambda = against > 0 ? against : at.g.norm();
  const Matrix3 bent = across * at.bend;
  Matrix3 A = bent * across;
  A.diagonal().array() += lambda;
  const Vector3 slope = across * at.g;
  return -(A.inverse() * slope);
}

/// @param target  `from(x)`: the PointDistance of x from it; `still<U>()`: itself at rest, in numbers U
template <class T, class Target>
Triple<T> nearest_of_disc(const PlacedDisc<T>& disc, const Target& target) {
  const auto still = target.template still<double>();
  PlacedDisc<double> values{Triple<double>(value_of(disc.middle)), {}};
  for (std::size_t k = 0; k < 3; ++k) values.half_axes[k] = Triple<double>(value_of(disc.half_axes[k]));
  const auto distance = [&](const Vector3& w) { return still.from(values.at(Triple<double>(w))).distance; };

  Vector3 w = -value_of(values.along(still.from(values.middle).normal)).normalized();
  DiscEquation at = disc_equation(values, w, still);
  double least = distance(w);
  constexpr int most = 60;
  for (int k = 0; k < most; ++k) {
    const Vector3 step = step_on_disc(at, w);
    if (!(step.norm() > 1e-15)) break;
    const double slope = at.g.dot(step);
    double share = 1;
    Vector3 next = (w + step).normalized();
    double now = distance(next);
    // Near the end, what a step brings is below rounding: whole steps are right there.
    while (now > least + 1e-4 * share * slope && share * step.norm() > 1e-7) {
      share *= 0.5;
      next = (w + share * step).normalized();
      now = distance(next);
    }
    const bool settled = (next - w).norm() <= 1e-15;
    w = next;
    least = now;
    at = disc_equation(values, w, still);
    if (settled) break;
  }
  Matrix3 K = at.bend;
  K.diagonal().array() -= at.g.dot(w);
  const Matrix3 K_inverse = K.inverse();
  const Vector3 u = K_inverse * w;
  const Matrix3 S = K_inverse - u * u.transpose() / w.dot(u);
  const Triple<T> fixed(w), g = disc.along(target.from(disc.at(fixed)).normal);
  const auto row = [&](int k) { return dot(Triple<T>(Vector3(S.row(k).transpose())), g - Triple<T>(at.g)); };
  return disc.at(fixed - Triple<T>(row(0), row(1), row(2)));
}

}  // namespace bielle::mechanism
