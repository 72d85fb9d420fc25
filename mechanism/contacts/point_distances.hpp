// Distances of a point from the cores of shapes, with the direction from the core to the point.
#pragma once

#include <array>
#include <cmath>

#include "mechanism/contacts/pair_touches.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

template <class T>
struct PointDistance {
  T distance{};      ///< distance from the core; negative inside of a box or cylinder, behind a plane
  Triple<T> normal;  ///< direction from the core to the point
  Triple<T> foot;    ///< nearest point of the core
};

/// Returns a point of a shape that is given in the shape's axes.
template <class T>
Triple<T> point_of(const PlacedShape<T>& placed, const Vector3& c) {
  return placed.origin + T(c.x()) * placed.axes[0] + T(c.y()) * placed.axes[1] + T(c.z()) * placed.axes[2];
}

template <class T>
T clamped(const T& a, double low, double high) {
  const double value = value_of(a);
  return value < low ? T(low) : value > high ? T(high) : a;
}

template <class T>
PointDistance<T> distance_to_point(const Triple<T>& p, const Triple<T>& foot) {
  const Triple<T> way = p - foot;
  const T squared = dot(way, way);
  if (value_of(squared) < 1e-24)
    throw ComputationError("they have penetrated each other so deeply that the direction of the contact force is lost");
  const T distance = sqrt(squared);
  return {distance, (T(1) / distance) * way, foot};
}

template <class T>
PointDistance<T> distance_to_plane(const Triple<T>& p, const Triple<T>& origin, const Triple<T>& normal) {
  const T distance = dot(normal, p - origin);
  return {distance, normal, p - distance * normal};
}

/// @param a,b  ends of the segment
template <class T>
PointDistance<T> distance_to_segment(const Triple<T>& p, const Triple<T>& a, const Triple<T>& b) {
  const Triple<T> way = b - a;
  const T share = clamped(dot(way, p - a) / dot(way, way), 0, 1);
  return distance_to_point(p, a + share * way);
}

/// @param q  the point in the shape's axes @param half  half the edges of the core
template <class T>
PointDistance<T> distance_to_box(const Triple<T>& p, const Triple<T>& q, const PlacedShape<T>& box,
                                 const Vector3& half) {
  const std::array<T, 3> along = {q.x, q.y, q.z};
  std::array<T, 3> nearest;
  bool inside = true;
  std::size_t face = 0;
  double least = 1e300;
  for (std::size_t k = 0; k < 3; ++k) {
    const double limit = half[static_cast<Eigen::Index>(k)], value = value_of(along[k]);
    nearest[k] = clamped(along[k], -limit, limit);
    inside = inside && std::abs(value) <= limit;
    if (limit - std::abs(value) < least) {
      least = limit - std::abs(value);
      face = k;
    }
  }
  if (!inside)
    return distance_to_point(
        p, box.origin + nearest[0] * box.axes[0] + nearest[1] * box.axes[1] + nearest[2] * box.axes[2]);
  const double side = value_of(along[face]) > 0 ? 1 : -1;
  const Triple<T> normal = T(side) * box.axes[face];
  const T distance = T(side) * along[face] - T(half[static_cast<Eigen::Index>(face)]);
  return {distance, normal, p - distance * normal};
}

template <class T>
PointDistance<T> distance_to_cylinder(const Triple<T>& p, const Triple<T>& q, const PlacedShape<T>& cylinder,
                                      double radius, double half_length) {
  const T squared = q.x * q.x + q.y * q.y;
  const double around = std::sqrt(value_of(squared)), along = std::abs(value_of(q.z));
  if (around <= radius && along <= half_length) {
    if (half_length - along <= radius - around || around == 0) {
      const double side = value_of(q.z) > 0 ? 1 : -1;
      const Triple<T> normal = T(side) * cylinder.axes[2];
      const T distance = T(side) * q.z - T(half_length);
      return {distance, normal, p - distance * normal};
    }
    const T out = sqrt(squared);
    const Triple<T> normal = (q.x / out) * cylinder.axes[0] + (q.y / out) * cylinder.axes[1];
    const T distance = out - T(radius);
    return {distance, normal, p - distance * normal};
  }
  T share(1);
  if (around > radius) share = T(radius) / sqrt(squared);
  return distance_to_point(p, cylinder.origin + (share * q.x) * cylinder.axes[0] + (share * q.y) * cylinder.axes[1] +
                                  clamped(q.z, -half_length, half_length) * cylinder.axes[2]);
}

/// Distance of a point from the core of any shape except a surface.
template <class T>
PointDistance<T> distance_to_core(const Triple<T>& p, const PlacedShape<T>& placed) {
  const ContactShape& shape = *placed.shape;
  using Kind = ContactShape::Kind;
  if (shape.kind == Kind::sphere) return distance_to_point(p, placed.origin);
  if (shape.kind == Kind::plane) return distance_to_plane(p, placed.origin, placed.axes[2]);
  if (shape.kind == Kind::capsule)
    return distance_to_segment(p, point_of(placed, shape.corners()[0]), point_of(placed, shape.corners()[1]));
  const Triple<T> way = p - placed.origin;
  const Triple<T> q(dot(placed.axes[0], way), dot(placed.axes[1], way), dot(placed.axes[2], way));
  if (shape.kind == Kind::box) return distance_to_box(p, q, placed, shape.half - Vector3::Constant(shape.rounding));
  return distance_to_cylinder(p, q, placed, shape.radius - shape.rounding, shape.half_length - shape.rounding);
}

/// Returns the same values without derivatives.
template <class U, class T>
Triple<U> at_rest(const Triple<T>& a) {
  return Triple<U>(value_of(a));
}

/// Targets of distances: `from(p)`, and the target itself at rest in other numbers.
template <class T>
struct CoreTarget {
  PlacedShape<T> placed;
  PointDistance<T> from(const Triple<T>& p) const { return distance_to_core(p, placed); }
  template <class U>
  CoreTarget<U> still() const {
    return {{placed.shape,
             at_rest<U>(placed.origin),
             {at_rest<U>(placed.axes[0]), at_rest<U>(placed.axes[1]), at_rest<U>(placed.axes[2])}}};
  }
};
template <class T>
struct SegmentTarget {
  Triple<T> a, b;
  PointDistance<T> from(const Triple<T>& p) const { return distance_to_segment(p, a, b); }
  template <class U>
  SegmentTarget<U> still() const {
    return {at_rest<U>(a), at_rest<U>(b)};
  }
};
template <class T>
struct PointTarget {
  Triple<T> point;
  PointDistance<T> from(const Triple<T>& p) const { return distance_to_point(p, point); }
  template <class U>
  PointTarget<U> still() const {
    return {at_rest<U>(point)};
  }
};
template <class T>
struct PlaneTarget {
  Triple<T> origin, normal;
  PointDistance<T> from(const Triple<T>& p) const { return distance_to_plane(p, origin, normal); }
  template <class U>
  PlaneTarget<U> still() const {
    return {at_rest<U>(origin), at_rest<U>(normal)};
  }
};

}  // namespace bielle::mechanism
