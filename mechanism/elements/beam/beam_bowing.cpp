#include "mechanism/elements/beam/beam_bowing.hpp"

#include <cmath>

#include "mechanism/math/gauss.hpp"
#include "mechanism/math/inverse.hpp"

namespace bielle::mechanism {

BeamBowing::BeamBowing(const Matrix6& stiffness, const ElementSections& sections, const Vector3& along)
    : bows_(true), along_(along) {
  using Matrix3x6 = Eigen::Matrix<double, 3, 6>;
  Matrix3x6 of_sections = Matrix3x6::Zero();
  for (std::size_t g = 0; g < 3; ++g)
    of_sections += Gauss3::weight[g] * symmetric_inverse(sections.at[g].stiffness).topRows<3>();
  const Matrix3 across = Matrix3::Identity() - along * along.transpose();
  const Matrix3x6 bent = across * (Matrix3x6::Identity() - of_sections * stiffness);  // gamma_b of e
  Q_ = bent.transpose() * bent;
}

BeamBowing::Stretch BeamBowing::at(const Vector6& e) const {
  Stretch stretch;
  if (!bows_) return stretch;
  constexpr double nothing = 1e-20;  // coincident ends have no chord
  const double c = 1 + along_.dot(e.head<3>());
  stretch.Qe.noalias() = Q_ * e;
  const double G = stretch.G = e.dot(stretch.Qe), r = stretch.r = std::sqrt(c * c + G + nothing);
  stretch.chord = stretch.Qe;
  stretch.chord.head<3>() += c * along_;
  stretch.q = r + 0.1 * G / r - c;
  stretch.gradient = (1 - 0.1 * G / (r * r)) / r * stretch.chord + 0.2 / r * stretch.Qe;
  stretch.gradient.head<3>() -= along_;
  return stretch;
}

// With m = r dr/de:  d2r/de2 = (t t^T + Q - m m^T/r^2)/r, and q = r + G/(10 r) - c is differentiated twice by r and G.
Matrix6 BeamBowing::second_gradient(const Stretch& stretch) const {
  if (!bows_) return Matrix6::Zero();
  const double r = stretch.r, by_r = 1 - 0.1 * stretch.G / (r * r);
  const Vector6& m = stretch.chord;
  Matrix6 gradient = (by_r + 0.2) / r * Q_ + (0.2 * stretch.G / (r * r) - by_r) / (r * r * r) * m * m.transpose() -
                     0.2 / (r * r * r) * (m * stretch.Qe.transpose() + stretch.Qe * m.transpose());
  gradient.topLeftCorner<3, 3>() += by_r / r * along_ * along_.transpose();
  return gradient;
}

}  // namespace bielle::mechanism
