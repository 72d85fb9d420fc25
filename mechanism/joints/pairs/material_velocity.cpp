#include "mechanism/joints/pairs/material_velocity.hpp"

namespace bielle::mechanism {

template <int order>
PairVector<order> turned(const Matrix3& axes, const PairVector<order>& vector) {
  PairVector<order> result;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k) result[row] += axes(static_cast<int>(row), static_cast<int>(k)) * vector[k];
  return result;
}

template <int order>
PairMeasureOf<order> material_velocity(const NodeState& first, const NodeState& second, const PairVector<order>& e,
                                       const PairVector<order>& c) {
  const Vector3 e_hat = value_of<order>(e), c_2 = value_of<order>(c);
  PairMeasureOf<order> w = measure_position<order>(first, second, e_hat, Vector3::Zero(), c_2);
  w.value = w.rate(pair_rate(first, second));
  if constexpr (order == 2) {
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
  }
  return w;
}

template PairVector<1> turned<1>(const Matrix3&, const PairVector<1>&);
template PairVector<2> turned<2>(const Matrix3&, const PairVector<2>&);
template PairSlope material_velocity<1>(const NodeState&, const NodeState&, const PairVector<1>&, const PairVector<1>&);
template PairMeasure material_velocity<2>(const NodeState&, const NodeState&, const PairVector<2>&,
                                          const PairVector<2>&);

}  // namespace bielle::mechanism
