#include "mechanism/elements/beam_section.hpp"

#include <cmath>
#include <numbers>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

SectionConstants rectangle_constants(double width_y, double height_z) {
  const double a = std::max(width_y, height_z), c = std::min(width_y, height_z);
  const double pi = std::numbers::pi;
  double sum = 0;
  // Terms fall like n^-5: behind 2001 the rest is below 1e-15 of the first.
  for (int n = 2001; n >= 1; n -= 2) sum += std::tanh(n * pi * a / (2 * c)) / std::pow(n, 5);
  SectionConstants k;
  k.A = a * c;
  k.I_y = width_y * std::pow(height_z, 3) / 12;
  k.I_z = height_z * std::pow(width_y, 3) / 12;
  k.J = a * c * c * c * (1.0 / 3 - 64 / std::pow(pi, 5) * (c / a) * sum);
  k.k_y = k.k_z = 5.0 / 6;
  return k;
}

SectionConstants tube_constants(double outer_radius, double inner_radius) {
  const double ro2 = outer_radius * outer_radius, ri2 = inner_radius * inner_radius, m2 = ri2 / ro2;
  SectionConstants k;
  k.A = std::numbers::pi * (ro2 - ri2);
  k.I_y = k.I_z = k.A * (ro2 + ri2) / 4;
  k.J = 2 * k.I_y;
  k.k_y = k.k_z = 6 * (1 + m2) * (1 + m2) / (7 + 34 * m2 + 7 * m2 * m2);
  return k;
}

BeamSection BeamSection::homogeneous(const SectionConstants& k, double young, double shear, double density,
                                     double offset_y, double offset_z) {
  BeamSection section;
  const Vector3 o(0, offset_y, offset_z);
  Vector6 diagonal;
  diagonal << young * k.A, shear * k.k_y * k.A, shear * k.k_z * k.A, shear * k.J, young * k.I_y, young * k.I_z;
  // Strains at the centroid: Gamma_c = Gamma + Kappa x o.
  Matrix6 shift = Matrix6::Identity();
  shift.topRightCorner<3, 3>() = -skew(o);
  section.stiffness = shift.transpose() * diagonal.asDiagonal() * shift;
  section.mass = density * k.A;
  section.mass_offset = o;
  section.inertia = density * Vector3(k.I_y + k.I_z, k.I_y, k.I_z).asDiagonal().toDenseMatrix();
  return section;
}

}  // namespace bielle::mechanism
