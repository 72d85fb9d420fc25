#include "mechanism/joints/tyres/contact_patch.hpp"

#include "mechanism/joints/pairs/material_velocity.hpp"
#include "mechanism/joints/pairs/wheel_place.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Normal of the road below a wheel, along J_A, with the components of the wheel's axes along it.
template <int order>
struct RoadBelow {
  PairMeasureOf<order> distance, n_x, n_z;
  PairMeasureOf<order> b_1, b_2;  ///< components of z_B along the road and across it
  PairMeasureOf<order> squared;   ///< s^2
};

template <int order>
PairMeasureOf<order> aligned(const NodeState& first, const NodeState& second, const JointFrames& frames, int a, int b) {
  return measure_alignment<order>(first, second, frames.on_first.R.col(a), frames.on_second.R.col(b));
}

template <int order>
RoadBelow<order> calc_road(const NodeState& first, const NodeState& second, const JointFrames& frames, double radius,
                           const RoadProfile* road) {
  const Frame &A = frames.on_first, &B = frames.on_second;
  RoadBelow<order> below;
  const auto z = measure_position<order>(first, second, A.R.col(2), A.x, B.x);
  below.b_1 = aligned<order>(first, second, frames, 0, 2);
  below.b_2 = aligned<order>(first, second, frames, 1, 2);
  if (road) {
    const auto x = measure_position<order>(first, second, A.R.col(0), A.x, B.x);
    const RoadProfile::Foot<order> foot = road->foot<order>(x, z, radius);
    below.distance = foot.distance;
    below.n_x = foot.normal_x;
    below.n_z = foot.normal_z;
    below.b_1 = below.n_z * below.b_1 - below.n_x * aligned<order>(first, second, frames, 2, 2);
  } else {
    below.distance = z;
    below.n_z = PairMeasureOf<order>(1.0);
  }
  below.squared = square(below.b_1) + square(below.b_2);
  return below;
}

/// Multiplies a velocity by a number that depends on the positions: d(f w) = f dw + w df.
template <int order>
PairMeasureOf<order> carried(const PairMeasureOf<order>& factor, const PairMeasureOf<order>& velocity) {
  PairMeasureOf<order> result = velocity;
  result *= factor.value;
  if constexpr (order == 2) result.second.noalias() += velocity.gradient * factor.gradient.transpose();
  return result;
}

/// Returns the component of the relative angular velocity along an axis of node 1 that varies. @param e  components
/// along node 1
template <int order>
PairMeasureOf<order> turning_about(const NodeState& first, const NodeState& second, const PairVector<order>& e) {
  const Matrix3 R_21 = second.R.transpose() * first.R;
  const Vector3 e_1 = value_of<order>(e), e_2 = R_21 * e_1;
  PairMeasureOf<order> w;
  w.gradient.template segment<3>(3) = -e_1;
  w.gradient.template segment<3>(9) = e_2;
  if constexpr (order == 2) {
    Eigen::Matrix<double, 3, 12> de;
    for (int k = 0; k < 3; ++k) de.row(k) = e[static_cast<std::size_t>(k)].gradient.transpose();
    w.second.template block<3, 12>(3, 0) = -de;
    w.second.template block<3, 12>(9, 0) = R_21 * de;
    w.second.template block<3, 3>(9, 3) -= R_21 * skew(e_1);
    w.second.template block<3, 3>(9, 9) += skew(e_2);
  }
  return w;
}

/// Returns the component of the relative angular velocity along an axis of node 2. @param e_2  components along node 2
template <int order>
PairMeasureOf<order> turning_about(const NodeState& first, const NodeState& second, const Vector3& e_2) {
  const Matrix3 R_12 = first.R.transpose() * second.R;
  PairMeasureOf<order> w;
  w.gradient.template segment<3>(3) = -(R_12 * e_2);
  w.gradient.template segment<3>(9) = e_2;
  if constexpr (order == 2) {
    w.second.template block<3, 3>(3, 3) = -skew(R_12 * e_2);
    w.second.template block<3, 3>(3, 9) = R_12 * skew(e_2);
  }
  return w;
}

}  // namespace

PairSlope calc_deflection(const NodeState& first, const NodeState& second, const JointFrames& frames, double radius,
                          const RoadProfile* road) {
  const RoadBelow<1> below = calc_road<1>(first, second, frames, radius, road);
  // A wheel that lies flat has no lowest point. Its distance from the road is still defined.
  if (!(below.squared.value > flat_wheel * flat_wheel)) return -below.distance;
  return radius * sqrt(below.squared) - below.distance;
}

template <int order>
ContactPatch<order> calc_patch(const NodeState& first, const NodeState& second, const JointFrames& frames,
                               double radius, const RoadProfile* road) {
  const Frame &A = frames.on_first, &B = frames.on_second;
  const RoadBelow<order> below = calc_road<order>(first, second, frames, radius, road);
  if (!(below.squared.value > flat_wheel * flat_wheel))
    throw ComputationError("the wheel lies flat on the road, where it has no lowest point to roll on");
  const auto s = sqrt(below.squared), by_1 = below.b_1 / s, by_2 = below.b_2 / s;
  const auto &n_x = below.n_x, &n_z = below.n_z;
  ContactPatch<order> patch;
  patch.deflection = radius * s - below.distance;
  patch.camber = n_z * aligned<order>(first, second, frames, 2, 2);
  auto m_x = n_z * aligned<order>(first, second, frames, 2, 0), m_y = n_z * aligned<order>(first, second, frames, 2, 1);
  if (road) {
    patch.camber += n_x * aligned<order>(first, second, frames, 0, 2);
    m_x += n_x * aligned<order>(first, second, frames, 0, 0);
    m_y += n_x * aligned<order>(first, second, frames, 0, 1);
  }
  // The road's axes are (n_z, 0, -n_x) and y, along J_A.
  const PairMeasureOf<order> zero;
  const auto n = turned<order>(A.R, {n_x, zero, n_z}), t = turned<order>(A.R, {n_z * by_2, -by_1, -(n_x * by_2)}),
             l = turned<order>(A.R, {n_z * by_1, by_2, -(n_x * by_1)});
  const auto height = below.distance / s, over_s = height / s;
  auto arm = turned<order>(B.R, {-(over_s * m_x), -(over_s * m_y), zero});
  PairVector<order> middle;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k].value = B.x[static_cast<Eigen::Index>(k)];
    arm[k] += middle[k].value;
  }
  const auto forward = material_velocity<order>(first, second, t, middle),
             about_axis = turning_about<order>(first, second, B.R.col(2));
  patch.roll = carried<order>(1.0 / 3 * (height + 2 * radius), about_axis);
  patch.longitudinal = forward - patch.roll;
  patch.lateral = material_velocity<order>(first, second, l, arm);
  patch.spin = turning_about<order>(first, second, n) - carried<order>(patch.camber, about_axis);
  patch.forward = forward.value;
  return patch;
}

template ContactPatch<1> calc_patch(const NodeState&, const NodeState&, const JointFrames&, double, const RoadProfile*);
template ContactPatch<2> calc_patch(const NodeState&, const NodeState&, const JointFrames&, double, const RoadProfile*);

}  // namespace bielle::mechanism
