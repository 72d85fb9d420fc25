#include "mechanism/joints/flexible/clearance_contact.hpp"

#include <cmath>

namespace bielle::mechanism {

using Place = ClearancePlace::Kind;

namespace {

bool is_face(Place kind) { return kind == Place::face || kind == Place::faces; }

constexpr double least_way = 1e-12;  // [m]: far below any gap, far above the rounding of its square

}  // namespace

//   n = rho/l,   dn = (I - n n^T) drho/l,   dp = n . drho,   second derivatives n . d2rho + drho . (I - n n^T) drho/l
ClearanceContact::ClearanceContact(const NodeState& first, const NodeState& second, const JointFrames& frames,
                                   const ClearancePlace& place, const PairRotation& rotation, bool second_derivatives)
    : place_(place), rotation_(rotation) {
  const Frame &A = frames.on_first, &B = frames.on_second;
  const Vector3 point = B.x + place.along * B.R.col(2);
  for (int k = 0; k < 3; ++k) {
    PairMeasure& s = s_[static_cast<std::size_t>(k)];
    if (second_derivatives) {
      s = measure_position(first, second, A.R.col(k), A.x, point);
    } else {
      const PairSlope slope = measure_position<1>(first, second, A.R.col(k), A.x, point);
      s.value = slope.value;
      s.gradient = slope.gradient;
    }
  }
  W_ = rotation.rate_gradients();
  if (is_face(place.kind)) {
    // Collars without play also touch in the middle position, where the force is zero but the stiffness is not.
    p_ = place.kind == Place::face ? place.side * s_[2] - place.gap : sqrt(square(s_[2]) + least_way * least_way);
    Y_.row(0) = s_[0].gradient.transpose();
    Y_.row(1) = s_[1].gradient.transpose();
    Y_.row(2) = place.radius * W_.row(2);
    return;
  }
  const int dimensions = place.kind == Place::bore ? 2 : 3;
  Vector3 rho = Vector3::Zero();
  for (int k = 0; k < dimensions; ++k) rho[k] = s_[static_cast<std::size_t>(k)].value;
  // Without a gap, the parts also touch in the centred position, where the force has no direction but the stiffness has
  // a limit.
  const double l = place.gap > 0 ? rho.norm() : std::hypot(rho.norm(), least_way);
  p_.value = l - place.gap;
  if (p_.value <= 0) return;
  n_ = rho / l;
  Rows slope = Rows::Zero(), all = Rows::Zero();  // drho/dz, ds/dz
  for (int k = 0; k < 3; ++k) all.row(k) = s_[static_cast<std::size_t>(k)].gradient.transpose();
  slope.topRows(dimensions) = all.topRows(dimensions);
  p_.gradient = slope.transpose() * n_;
  n_slope_ = (slope - n_ * p_.gradient.transpose()) / l;
  Y_ = all - place.radius * skew(n_) * W_;
  if (!second_derivatives) return;
  for (int k = 0; k < dimensions; ++k) p_.second += n_[k] * s_[static_cast<std::size_t>(k)].second;
  p_.second += slope.transpose() * n_slope_;
}

ClearanceContact::Rows ClearanceContact::turned_sliding(const Vector3& w) const {
  return -n_.dot(w) * n_slope_ - n_ * (w.transpose() * n_slope_);
}

//   Y^T f = sum f_k ds_k + r W^T (n x f),   d(n x f) = -f~ dn
Matrix12 ClearanceContact::Z(const Vector3& f) const {
  Matrix12 Z = Matrix12::Zero();
  if (is_face(place_.kind)) {
    Z = f[0] * s_[0].second + f[1] * s_[1].second;
    rotation_.add_rate_second(place_.radius * f[2] * Vector3::UnitZ(), Z);
    return Z;
  }
  for (int k = 0; k < 3; ++k) Z += f[k] * s_[static_cast<std::size_t>(k)].second;
  rotation_.add_rate_second(place_.radius * n_.cross(f), Z);
  const Rows turned = skew(f) * n_slope_;
  Z -= place_.radius * W_.transpose() * turned;
  return Z;
}

}  // namespace bielle::mechanism
