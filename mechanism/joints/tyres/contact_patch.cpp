#include "mechanism/joints/tyres/contact_patch.hpp"

#include "mechanism/joints/pairs/material_velocity.hpp"
#include "mechanism/joints/pairs/wheel_place.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Normal of the road below a wheel, along J_A, with the components of the wheel's axes along it.
struct RoadBelow {
  PairMeasure distance, n_x, n_z;
  PairMeasure b_1, b_2;  ///< components of z_B along the road and across it
  PairMeasure squared;   ///< s^2
};

PairMeasure aligned(const NodeState& first, const NodeState& second, const JointFrames& frames, int a, int b) {
  return measure_alignment(first, second, frames.on_first.R.col(a), frames.on_second.R.col(b));
}

RoadBelow calc_road(const NodeState& first, const NodeState& second, const JointFrames& frames, double radius,
                    const RoadProfile* road) {
  const Frame &A = frames.on_first, &B = frames.on_second;
  RoadBelow below;
  const PairMeasure z = measure_position(first, second, A.R.col(2), A.x, B.x);
  below.b_1 = aligned(first, second, frames, 0, 2);
  below.b_2 = aligned(first, second, frames, 1, 2);
  if (road) {
    const PairMeasure x = measure_position(first, second, A.R.col(0), A.x, B.x);
    const RoadProfile::Foot foot = road->foot(x, z, radius);
    below.distance = foot.distance;
    below.n_x = foot.normal_x;
    below.n_z = foot.normal_z;
    below.b_1 = below.n_z * below.b_1 - below.n_x * aligned(first, second, frames, 2, 2);
  } else {
    below.distance = z;
    below.n_z = PairMeasure(1.0);
  }
  below.squared = square(below.b_1) + square(below.b_2);
  return below;
}

/// Multiplies a velocity by a number that depends on the positions: d(f w) = f dw + w df.
PairMeasure carried(const PairMeasure& factor, const PairMeasure& velocity) {
  PairMeasure result = velocity;
  result *= factor.value;
  result.second.noalias() += velocity.gradient * factor.gradient.transpose();
  return result;
}

/// Component of the relative angular velocity along an axis of node 1 that varies. @param e  components along node 1
PairMeasure turning_about(const NodeState& first, const NodeState& second, const VectorJet& e) {
  const Matrix3 R_21 = second.R.transpose() * first.R;
  const Vector3 e_1 = value_of(e), e_2 = R_21 * e_1;
  Eigen::Matrix<double, 3, 12> de;
  for (int k = 0; k < 3; ++k) de.row(k) = e[static_cast<std::size_t>(k)].gradient.transpose();
  PairMeasure w;
  w.gradient.segment<3>(3) = -e_1;
  w.gradient.segment<3>(9) = e_2;
  w.second.block<3, 12>(3, 0) = -de;
  w.second.block<3, 12>(9, 0) = R_21 * de;
  w.second.block<3, 3>(9, 3) -= R_21 * skew(e_1);
  w.second.block<3, 3>(9, 9) += skew(e_2);
  return w;
}

/// Component of the relative angular velocity along an axis of node 2. @param e_2  components along node 2
PairMeasure turning_about(const NodeState& first, const NodeState& second, const Vector3& e_2) {
  const Matrix3 R_12 = first.R.transpose() * second.R;
  PairMeasure w;
  w.gradient.segment<3>(3) = -(R_12 * e_2);
  w.gradient.segment<3>(9) = e_2;
  w.second.block<3, 3>(3, 3) = -skew(R_12 * e_2);
  w.second.block<3, 3>(3, 9) = R_12 * skew(e_2);
  return w;
}

}  // namespace

PairMeasure calc_deflection(const NodeState& first, const NodeState& second, const JointFrames& frames, double radius,
                            const RoadProfile* road) {
  const RoadBelow below = calc_road(first, second, frames, radius, road);
  // A wheel that lies flat has no lowest point, but a distance from the road.
  if (!(below.squared.value > flat_wheel * flat_wheel)) return -below.distance;
  return radius * sqrt(below.squared) - below.distance;
}

ContactPatch calc_patch(const NodeState& first, const NodeState& second, const JointFrames& frames, double radius,
                        const RoadProfile* road) {
  const Frame &A = frames.on_first, &B = frames.on_second;
  const RoadBelow below = calc_road(first, second, frames, radius, road);
  if (!(below.squared.value > flat_wheel * flat_wheel))
    throw ComputationError("the wheel lies flat on the road, where it has no lowest point to roll on");
  const PairMeasure s = sqrt(below.squared), by_1 = below.b_1 / s, by_2 = below.b_2 / s;
  const PairMeasure &n_x = below.n_x, &n_z = below.n_z;
  ContactPatch patch;
  patch.deflection = radius * s - below.distance;
  patch.camber = n_z * aligned(first, second, frames, 2, 2);
  PairMeasure m_x = n_z * aligned(first, second, frames, 2, 0), m_y = n_z * aligned(first, second, frames, 2, 1);
  if (road) {
    patch.camber += n_x * aligned(first, second, frames, 0, 2);
    m_x += n_x * aligned(first, second, frames, 0, 0);
    m_y += n_x * aligned(first, second, frames, 0, 1);
  }
  // The road's axes are (n_z, 0, -n_x) and y, along J_A.
  const PairMeasure zero;
  const VectorJet n = turned(A.R, {n_x, zero, n_z}), t = turned(A.R, {n_z * by_2, -by_1, -(n_x * by_2)}),
                  l = turned(A.R, {n_z * by_1, by_2, -(n_x * by_1)});
  const PairMeasure height = below.distance / s, over_s = height / s;
  VectorJet arm = turned(B.R, {-(over_s * m_x), -(over_s * m_y), zero}), middle;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k].value = B.x[static_cast<Eigen::Index>(k)];
    arm[k] += middle[k].value;
  }
  const PairMeasure forward = material_velocity(first, second, t, middle),
                    about_axis = turning_about(first, second, B.R.col(2));
  patch.roll = carried(1.0 / 3 * (height + 2 * radius), about_axis);
  patch.longitudinal = forward - patch.roll;
  patch.lateral = material_velocity(first, second, l, arm);
  patch.spin = turning_about(first, second, n) - carried(patch.camber, about_axis);
  patch.forward = forward.value;
  return patch;
}

}  // namespace bielle::mechanism
