#include "mechanism/elements/beam/beam_section.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

BeamSection BeamSection::homogeneous(const SectionConstants& k, double young, double shear, double density,
                                     const Vector2& offset) {
  BeamSection section;
  const Vector3 o(0, offset.x(), offset.y()), s = o + Vector3(0, k.shear_centre.x(), k.shear_centre.y());
  // Maps strains at the node line to (gamma_x at the centroid, gamma_y and gamma_z at the shear centre, Kappa).
  Matrix6 strains = Matrix6::Identity();
  strains.block<1, 3>(0, 3) = -skew(o).row(0);
  strains.block<2, 3>(1, 3) = -skew(s).bottomRows<2>();
  Matrix6 C = Matrix6::Zero();
  C(0, 0) = young * k.A;
  C.block<2, 2>(1, 1) = shear * k.shear_area;
  C(3, 3) = shear * k.J;
  C.block<2, 2>(4, 4) << young * k.I_y, -young * k.I_yz, -young * k.I_yz, young * k.I_z;
  section.stiffness = strains.transpose() * C * strains;
  section.mass = density * k.A;
  section.mass_offset = o;
  section.inertia << k.I_y + k.I_z, 0, 0, 0, k.I_y, -k.I_yz, 0, -k.I_yz, k.I_z;
  section.inertia *= density;
  return section;
}

void BeamSection::set_mass(const Matrix6& M) {
  mass = M.topLeftCorner<3, 3>().trace() / 3;
  mass_offset = mass > 0 ? Vector3(skew_vector(M.bottomLeftCorner<3, 3>()) / mass) : Vector3::Zero();
  inertia = M.bottomRightCorner<3, 3>() + mass * skew(mass_offset) * skew(mass_offset);
}

double BeamSection::largest_strain(const Vector6& strain) const {
  const Matrix6& C = stiffness;
  const Vector2 centroid = Vector2(-C(0, 5), C(0, 4)) / C(0, 0);
  Vector2 farthest = reach;
  if (farthest.isZero())
    farthest = Vector2(std::sqrt(3 * std::max(0.0, C(5, 5) / C(0, 0) - centroid.x() * centroid.x())),
                       std::sqrt(3 * std::max(0.0, C(4, 4) / C(0, 0) - centroid.y() * centroid.y())));
  constexpr double young_over_shear = 2.6;
  const double twist = twist_reach > 0 ? twist_reach : std::sqrt(2 * young_over_shear * C(3, 3) / C(0, 0));
  const double axial = strain[0] + strain[4] * centroid.y() - strain[5] * centroid.x();
  const double normal = std::abs(axial) + std::hypot(strain[4] * farthest.y(), strain[5] * farthest.x());
  const double shear = std::hypot(strain[1], strain[2]) + std::abs(strain[3]) * twist;
  return std::max(normal, 2.0 / 3 * shear);
}

BeamSection BeamSection::shifted(const Vector2& offset) const {
  const Vector3 o(0, offset.x(), offset.y());
  // Maps strains at the node line to those at the section's origin: Gamma + Kappa x o.
  Matrix6 strains = Matrix6::Identity();
  strains.topRightCorner<3, 3>() = -skew(o);
  BeamSection section = *this;
  section.stiffness = strains.transpose() * stiffness * strains;
  section.mass_offset += o;
  return section;
}

}  // namespace bielle::mechanism
