#include "mechanism/elements/beam/span_motion.hpp"

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

const std::vector<std::string>& span_variables() {
  static const std::vector<std::string> names{"s", "t", "vx", "vy", "vz", "section_vx", "section_vy", "section_vz"};
  return names;
}

SpanValues span_values(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const LocalState& state) {
  const Vector3 v = span_velocity(point, state), u = at.S.transpose() * v;
  return {point.along(span), state.time(), v[0], v[1], v[2], u[0], u[1], u[2]};
}

SpanGradients span_gradients(const BeamSpan& span, const SpanPoint& point, const SpanSection& at,
                             const LocalState& state) {
  SpanGradients gradients;
  gradients.by_position.setZero();
  gradients.by_rate.setZero();
  const Matrix3 to_section = at.S.transpose(), turned = skew(to_section * span_velocity(point, state));
  for (std::size_t k = 0; k < 2; ++k) {
    const NodeState& node = state.node(static_cast<int>(k));
    const auto x = static_cast<Eigen::Index>(6 * k), Theta = x + 3;
    const Matrix3 along = point.N[k] * Matrix3::Identity(), by_turn = -node.R * skew(point.a[k]);
    const Matrix3 v_by_turn = -node.R * skew(node.Omega.cross(point.a[k]));
    gradients.by_position.block<3, 3>(span_v, Theta) = v_by_turn;
    gradients.by_position.block<3, 3>(span_section_v, Theta) =
        to_section * v_by_turn + turned * at.W[k] * span.section_frame(k).transpose();
    gradients.by_rate.block<3, 3>(span_v, x) = along;
    gradients.by_rate.block<3, 3>(span_v, Theta) = by_turn;
    gradients.by_rate.block<3, 3>(span_section_v, x) = point.N[k] * to_section;
    gradients.by_rate.block<3, 3>(span_section_v, Theta) = to_section * by_turn;
  }
  return gradients;
}

}  // namespace bielle::mechanism
