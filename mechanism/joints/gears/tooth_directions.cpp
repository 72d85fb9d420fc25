#include "mechanism/joints/gears/tooth_directions.hpp"

#include <cmath>
#include <stdexcept>

namespace bielle::mechanism {
namespace {

constexpr double parallel_sine = 1e-6;  ///< sine of the angle below which directions are considered parallel

/// Returns the line of contact of the pitch surfaces of rolling wheels.
Vector3 rolling_line(const ToothGeometry& geometry, const Vector3& v_1, const Vector3& v_2) {
  const Vector3 along = v_1.normalized();
  const double a_1 = v_1.dot(along), a_2 = v_2.dot(along);
  const Vector3 line = geometry.axis[0] / a_1 - geometry.axis[1] / a_2;
  if (line.norm() < 1e-9 / std::abs(a_1))
    throw std::domain_error("the wheels turn about the same axis, with equal radii: their teeth do not roll");
  return line.normalized();
}

}  // namespace

void set_tooth_directions(ToothGeometry& geometry, double helix, bool inside) {
  std::array<Vector3, 2> v;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3 arm = geometry.P - geometry.centre[k];
    v[k] = geometry.axis[k].cross(arm);
    if (v[k].norm() <= 1e-9 * arm.norm() || arm.norm() == 0)
      throw std::domain_error(k == 0 ? "it lies on the axis of the first wheel"
                                     : "it lies on the axis of the second wheel");
  }
  const Vector3 &z_1 = geometry.axis[0], along = v[0].normalized();
  Vector3 g;
  if (const Vector3 across = along.cross(v[1].normalized()); across.norm() < parallel_sine) {
    g = rolling_line(geometry, v[0], v[1]);
    if (g.dot(z_1) < 0) g = -g;
    geometry.nu = along.cross(g);
  } else {
    geometry.nu = across.normalized();
    for (const Vector3& axis : geometry.axis)
      if (std::abs(axis.dot(geometry.nu)) > parallel_sine)
        throw std::domain_error("the teeth of crossed wheels meet on the common perpendicular of their axes");
    g = z_1;
  }
  const Vector3 arm = geometry.P - geometry.centre[0];
  // nu points away from the axis of wheel 1; for a crown wheel, whose teeth point along its axis, towards the axis of
  // wheel 2.
  const Vector3 &z_2 = geometry.axis[1], arm_2 = geometry.P - geometry.centre[1];
  const double from_first = geometry.nu.dot(arm - z_1 * z_1.dot(arm)) / v[0].norm(),
               from_second = geometry.nu.dot(arm_2 - z_2 * z_2.dot(arm_2)) / v[1].norm();
  const bool crown = std::abs(from_first) < 1e-6;
  if (crown && helix != 0)
    throw std::domain_error("the first wheel is flat: name the other first, whose helix has a hand");
  const bool outwards = crown ? from_second < 0 : from_first > 0;
  if (outwards == inside) geometry.nu = -geometry.nu;
  geometry.t = std::cos(helix) * along - std::sin(helix) * g;
  if (std::abs(v[1].dot(geometry.t)) < 1e-6 * v[1].norm())
    throw std::domain_error("with this helix angle the teeth do not turn the second wheel");
}

}  // namespace bielle::mechanism
