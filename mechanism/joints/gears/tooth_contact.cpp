#include "mechanism/joints/gears/tooth_contact.hpp"

#include <limits>

#include "mechanism/math/axes_along.hpp"
#include "mechanism/measures/turns.hpp"

namespace bielle::mechanism {
namespace {

/// Extends a measure of carrier and one wheel to the three nodes.
template <int order>
MeshMeasureOf<order> in_mesh(const PairMeasureOf<order>& pair, int wheel) {
  const int at = wheel == 0 ? 6 : 12;
  MeshMeasureOf<order> m(pair.value);
  m.gradient.template head<6>() = pair.gradient.template head<6>();
  m.gradient.template segment<6>(at) = pair.gradient.template tail<6>();
  if constexpr (order == 2) {
    m.second.template topLeftCorner<6, 6>() = pair.second.template topLeftCorner<6, 6>();
    m.second.template block<6, 6>(0, at) = pair.second.template topRightCorner<6, 6>();
    m.second.template block<6, 6>(at, 0) = pair.second.template bottomLeftCorner<6, 6>();
    m.second.template block<6, 6>(at, at) = pair.second.template bottomRightCorner<6, 6>();
  }
  return m;
}

}  // namespace

ToothContact::ToothContact(const ToothGeometry& geometry)
    : geometry_(geometry), on_carrier_{axes_along(geometry.axis[0]), axes_along(geometry.axis[1])} {
  // The frames of wheels and carrier coincide in the initial position. They are given in the axes of the wheels.
  for (std::size_t k = 0; k < 2; ++k) geometry_.wheel[k] = geometry_.wheel[k] * on_carrier_[k];
}

template <int order>
PairMeasureOf<order> ToothContact::angle(int wheel, const LocalState& state) const {
  const auto k = static_cast<std::size_t>(wheel);
  const NodeState &carrier = state.node(0), &node = state.node(1 + wheel);
  PairMeasureOf<order> m = measure_angle<order>(carrier, node, on_carrier_[k], geometry_.wheel[k]);
  const auto memory = state.memory();
  const CoordinateRate principal{m.value, m.rate(pair_rate(carrier, node))};
  m.value = counted_angle(principal, {memory[2 * wheel], memory[2 * wheel + 1]}, memory[4], state);
  return m;
}

template <int order>
PairMeasureOf<order> ToothContact::displacement(int wheel, const Vector3& e, const LocalState& state) const {
  const auto k = static_cast<std::size_t>(wheel);
  const NodeState &carrier = state.node(0), &node = state.node(1 + wheel);
  const Vector3 &z = geometry_.axis[k], &c = geometry_.centre[k];
  const Vector3 moment = (geometry_.P - c).cross(e);
  // m . tau = m . (z x z') = z' . (m x z)
  const Vector3 tilting = moment.cross(z), wheel_axis = geometry_.wheel[k].col(2);
  return measure_position<order>(carrier, node, e, c, Vector3::Zero()) +
         measure_alignment<order>(carrier, node, tilting, wheel_axis) + moment.dot(z) * angle<order>(wheel, state);
}

template <int order>
MeshMeasureOf<order> ToothContact::approach(const Vector3& e, const LocalState& state) const {
  return in_mesh<order>(displacement<order>(0, e, state), 0) - in_mesh<order>(displacement<order>(1, e, state), 1);
}

template <int order>
MeshMeasureOf<order> ToothContact::turned(int wheel, const LocalState& state) const {
  return in_mesh<order>(angle<order>(wheel, state), wheel);
}

template MeshSlope ToothContact::approach(const Vector3&, const LocalState&) const;
template MeshMeasure ToothContact::approach(const Vector3&, const LocalState&) const;
template MeshSlope ToothContact::turned(int, const LocalState&) const;
template MeshMeasure ToothContact::turned(int, const LocalState&) const;

double ToothContact::arm(int wheel) const {
  const auto k = static_cast<std::size_t>(wheel);
  return (geometry_.P - geometry_.centre[k]).cross(geometry_.t).dot(geometry_.axis[k]);
}

void ToothContact::declare_memory(Declaration& declaration) {
  declaration.memory.insert(declaration.memory.end(), {0, 0, 0, 0, std::numeric_limits<double>::quiet_NaN()});
}

void ToothContact::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  for (const int wheel : {0, 1}) {
    const PairSlope m = angle<1>(wheel, state);
    memory[2 * wheel] = m.value;
    memory[2 * wheel + 1] = m.rate(pair_rate(state.node(0), state.node(1 + wheel)));
  }
  memory[4] = state.time();
}

MeshMeasure::Gradient ToothContact::rates(const LocalState& state) {
  MeshMeasure::Gradient v;
  for (const int k : {0, 1, 2}) v.segment<6>(6 * k) << state.node(k).v, state.node(k).Omega;
  return v;
}

MeshMeasure::Gradient ToothContact::accelerations(const LocalState& state) {
  MeshMeasure::Gradient a;
  for (const int k : {0, 1, 2}) a.segment<6>(6 * k) << state.node(k).a, state.node(k).Omegadot;
  return a;
}

}  // namespace bielle::mechanism
