#include "mechanism/model/state.hpp"

namespace bielle::mechanism {
namespace {

template <class OfNode, class OfAmplitudes>
void gather(const LocalState& state, Eigen::Ref<VectorX> result, const OfNode& of_node,
            const OfAmplitudes& of_amplitudes) {
  const Slots& slots = state.slots();
  result.head(slots.own_size()).setZero();
  for (int k = 0; k < static_cast<int>(slots.nodes.size()); ++k) {
    const auto& [translation, rotation] = of_node(state.node(k));
    result.segment<3>(6 * k) = translation;
    result.segment<3>(6 * k + 3) = rotation;
  }
  result.segment(slots.amplitude_row(), slots.amplitudes) = of_amplitudes(state);
  for (int k = 0; k < static_cast<int>(slots.references.size()); ++k)
    gather(state.of(k), result.segment(slots.reference_row(k), slots.references[static_cast<std::size_t>(k)]->size()),
           of_node, of_amplitudes);
}

}  // namespace

void get_local_velocities(const LocalState& state, Eigen::Ref<VectorX> v) {
  gather(
      state, v, [](const NodeState& node) { return std::pair<const Vector3&, const Vector3&>(node.v, node.Omega); },
      [](const LocalState& local) { return local.amplitude_rate(); });
}

void get_local_accelerations(const LocalState& state, Eigen::Ref<VectorX> a) {
  gather(
      state, a, [](const NodeState& node) { return std::pair<const Vector3&, const Vector3&>(node.a, node.Omegadot); },
      [](const LocalState& local) { return local.amplitude_acceleration(); });
}

}  // namespace bielle::mechanism
