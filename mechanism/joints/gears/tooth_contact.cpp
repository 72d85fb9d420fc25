#include "mechanism/joints/gears/tooth_contact.hpp"

#include <limits>

#include "mechanism/math/axes_along.hpp"
#include "mechanism/measures/turns.hpp"

namespace bielle::mechanism {
namespace {

/// Extends a measure of carrier and one wheel to the three nodes.
MeshMeasure in_mesh(const PairMeasure& pair, int wheel) {
  const int at = wheel == 0 ? 6 : 12;
  MeshMeasure m;
  m.value = pair.value;
  m.gradient.head<6>() = pair.gradient.head<6>();
  m.gradient.segment<6>(at) = pair.gradient.tail<6>();
  m.second.topLeftCorner<6, 6>() = pair.second.topLeftCorner<6, 6>();
  m.second.block<6, 6>(0, at) = pair.second.topRightCorner<6, 6>();
  m.second.block<6, 6>(at, 0) = pair.second.bottomLeftCorner<6, 6>();
  m.second.block<6, 6>(at, at) = pair.second.bottomRightCorner<6, 6>();
  return m;
}

}  // namespace

ToothContact::ToothContact(const ToothGeometry& geometry)
    : geometry_(geometry), on_carrier_{axes_along(geometry.axis[0]), axes_along(geometry.axis[1])} {
  // The wheels' frames follow from their initial positions: in the axes of the wheels, those of the carrier.
  for (std::size_t k = 0; k < 2; ++k) geometry_.wheel[k] = geometry_.wheel[k] * on_carrier_[k];
}

PairMeasure ToothContact::angle(int wheel, const LocalState& state) const {
  const auto k = static_cast<std::size_t>(wheel);
  const NodeState &carrier = state.node(0), &node = state.node(1 + wheel);
  PairMeasure m = measure_angle(carrier, node, on_carrier_[k], geometry_.wheel[k]);
  const auto memory = state.memory();
  const CoordinateRate principal{m.value, m.rate(pair_rate(carrier, node))};
  m.value = counted_angle(principal, {memory[2 * wheel], memory[2 * wheel + 1]}, memory[4], state);
  return m;
}

PairMeasure ToothContact::displacement(int wheel, const Vector3& e, const LocalState& state) const {
  const auto k = static_cast<std::size_t>(wheel);
  const NodeState &carrier = state.node(0), &node = state.node(1 + wheel);
  const Vector3 &z = geometry_.axis[k], &c = geometry_.centre[k];
  const Vector3 moment = (geometry_.P - c).cross(e);
  // m . tau = m . (z x z') = z' . (m x z)
  const Vector3 tilting = moment.cross(z), wheel_axis = geometry_.wheel[k].col(2);
  return measure_position(carrier, node, e, c, Vector3::Zero()) +
         measure_alignment(carrier, node, tilting, wheel_axis) + moment.dot(z) * angle(wheel, state);
}

MeshMeasure ToothContact::approach(const Vector3& e, const LocalState& state) const {
  return in_mesh(displacement(0, e, state), 0) - in_mesh(displacement(1, e, state), 1);
}

MeshMeasure ToothContact::turned(int wheel, const LocalState& state) const {
  return in_mesh(angle(wheel, state), wheel);
}

double ToothContact::arm(int wheel) const {
  const auto k = static_cast<std::size_t>(wheel);
  return (geometry_.P - geometry_.centre[k]).cross(geometry_.t).dot(geometry_.axis[k]);
}

void ToothContact::declare_memory(Declaration& declaration) {
  declaration.memory.insert(declaration.memory.end(), {0, 0, 0, 0, std::numeric_limits<double>::quiet_NaN()});
}

void ToothContact::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  for (const int wheel : {0, 1}) {
    const PairMeasure m = angle(wheel, state);
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
