// Shapes of contacts, made and placed without a model, and the sum of the contact forces between two.
#pragma once

#include "mechanism/contacts/pair_touches.hpp"

namespace bielle::test {

inline mechanism::ContactShape round_shape(mechanism::ContactShape::Kind kind, double radius, double half_length,
                                           double rounding = 0) {
  mechanism::ContactShape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  shape.rounding = rounding;
  shape.complete();
  return shape;
}

inline mechanism::ContactShape box_shape(const mechanism::Vector3& half, double rounding) {
  mechanism::ContactShape shape;
  shape.kind = mechanism::ContactShape::Kind::box;
  shape.half = half;
  shape.rounding = rounding;
  shape.complete();
  return shape;
}

inline mechanism::ContactShape surface_shape(const std::vector<mechanism::Vector3>& corners) {
  mechanism::ContactShape shape;
  shape.kind = mechanism::ContactShape::Kind::surface;
  shape.surface = std::make_shared<const mechanism::TriangleSurface>(corners);
  shape.complete();
  return shape;
}

inline mechanism::PlacedShape<double> placed_at(const mechanism::ContactShape& shape, const mechanism::Vector3& x,
                                                const mechanism::Matrix3& A = mechanism::Matrix3::Identity()) {
  mechanism::PlacedShape<double> result;
  result.shape = &shape;
  result.origin = mechanism::Triple<double>(x);
  for (int k = 0; k < 3; ++k)
    result.axes[static_cast<std::size_t>(k)] = mechanism::Triple<double>(mechanism::Vector3(A.col(k)));
  return result;
}

/// Force on the second shape, its moment about that shape's origin, and the potential.
struct Pressed {
  mechanism::Vector3 force, moment;
  double potential;
};
inline Pressed pressed(const mechanism::PlacedShape<double>& first, const mechanism::PlacedShape<double>& second,
                       const mechanism::NormalLaw& law) {
  mechanism::PairTouches<double> found;
  find_touches(first, second, law, found);
  Pressed sum{mechanism::Vector3::Zero(), mechanism::Vector3::Zero(), found.potential};
  for (const auto& touch : found.touches) {
    const mechanism::Vector3 force = touch.force * value_of(touch.normal);
    sum.force += force;
    sum.moment += value_of(touch.place - second.origin).cross(force);
  }
  return sum;
}

}  // namespace bielle::test
