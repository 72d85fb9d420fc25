#include "mechanism/joints/pairs/material_velocity.hpp"

namespace bielle::mechanism {

VectorJet turned(const Matrix3& axes, const VectorJet& vector) {
  VectorJet result;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k) result[row] += axes(static_cast<int>(row), static_cast<int>(k)) * vector[k];
  return result;
}

PairMeasure material_velocity(const NodeState& first, const NodeState& second, const VectorJet& e, const VectorJet& c) {
  const Vector3 e_hat = value_of(e), c_2 = value_of(c);
  PairMeasure w = measure_position(first, second, e_hat, Vector3::Zero(), c_2);
  const Matrix3 R_12 = first.R.transpose() * second.R;
  const PointPair points(first, second, R_12, c_2);
  const Vector3 e_2 = R_12.transpose() * e_hat;
  for (int k = 0; k < 3; ++k) {
    const Vector3 unit = Vector3::Unit(k);
    w.second += points.gradient(unit) * e[static_cast<std::size_t>(k)].gradient.transpose();
    Vector12 by_arm = Vector12::Zero();
    by_arm.segment<3>(3) = e_hat.cross(R_12 * unit);
    by_arm.segment<3>(9) = unit.cross(e_2);
    w.second += by_arm * c[static_cast<std::size_t>(k)].gradient.transpose();
  }
  w.value = w.rate(pair_rate(first, second));
  return w;
}

}  // namespace bielle::mechanism
