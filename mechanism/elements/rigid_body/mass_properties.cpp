#include "mechanism/elements/rigid_body/mass_properties.hpp"

#include <numbers>

namespace bielle::mechanism {
namespace {

constexpr double pi = std::numbers::pi;

Matrix3 about_axis(double across, double along) { return Vector3(across, across, along).asDiagonal(); }

}  // namespace

Matrix3 MassProperties::inertia_about_origin() const { return inertia - mass * skew(centre) * skew(centre); }

MassProperties operator+(const MassProperties& a, const MassProperties& b) {
  MassProperties sum;
  sum.mass = a.mass + b.mass;
  sum.centre = (a.mass * a.centre + b.mass * b.centre) / sum.mass;
  const Matrix3 arm_a = skew(a.centre - sum.centre), arm_b = skew(b.centre - sum.centre);
  sum.inertia = a.inertia + b.inertia - a.mass * arm_a * arm_a - b.mass * arm_b * arm_b;
  return sum;
}

MassProperties operator*(double factor, const MassProperties& body) {
  return {factor * body.mass, body.centre, factor * body.inertia};
}

MassProperties placed(const Frame& H_BA, const MassProperties& body) {
  return {body.mass, H_BA.x + H_BA.R * body.centre, H_BA.R * body.inertia * H_BA.R.transpose()};
}

MassProperties box(const Vector3& edges) {
  const double mass = edges.prod();
  const Vector3 s = mass / 12 * edges.cwiseAbs2();
  return {mass, Vector3::Zero(), Vector3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()).asDiagonal()};
}

MassProperties sphere(double radius) {
  const double mass = 4.0 / 3 * pi * radius * radius * radius;
  return {mass, Vector3::Zero(), 0.4 * mass * radius * radius * Matrix3::Identity()};
}

MassProperties cylinder(double radius, double length) { return tube(radius, 0, length); }

MassProperties tube(double outer, double inner, double length) {
  const double mass = pi * (outer * outer - inner * inner) * length;
  const double along = 0.5 * mass * (outer * outer + inner * inner);
  return {mass, Vector3::Zero(), about_axis(0.5 * along + mass * length * length / 12, along)};
}

MassProperties cone(double below, double above, double length) {
  // Moments of the area pi r(z)^2 with linear r, from the lower end.
  const double a = below, b = above;
  const double squares = a * a + a * b + b * b;
  const double mass = pi * length / 3 * squares;
  const double height = length * (a * a + 2 * a * b + 3 * b * b) / (4 * squares);
  const double along =
      0.3 * mass * (a * a * a * a + a * a * a * b + a * a * b * b + a * b * b * b + b * b * b * b) / squares;
  const double across = 0.5 * along + pi * length * length * length * (a * a + 3 * a * b + 6 * b * b) / 30;
  return {mass, Vector3(0, 0, height - length / 2), about_axis(across - mass * height * height, along)};
}

MassProperties ring(double radius, double section) {
  const double R = radius * radius, r = section * section;
  const double mass = 2 * pi * pi * radius * r;
  return {mass, Vector3::Zero(), mass * about_axis(R / 2 + 5 * r / 8, R + 3 * r / 4)};
}

}  // namespace bielle::mechanism
