#include "mechanism/joints/cables/rope_span.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the component, along an axis of a pulley's frame on `node`, of the vector from there to a point of another
/// node.
template <int order>
PairMeasureOf<order> way(const NodeState& node, const NodeState& other, const Pulley& here, const Vector3& there,
                         int axis) {
  return measure_position<order>(node, other, here.on_node.R.col(axis), here.on_node.x, there);
}

}  // namespace

template <int order>
SpanMeasures<order> measure_span(const NodeState& first, const NodeState& second, const Pulley& from,
                                 const Pulley& to) {
  const Vector3 &p_i = from.on_node.x, &p_j = to.on_node.x;
  const double difference = from.radius - to.radius;
  std::array<PairMeasureOf<order>, 3> d;
  for (int axis = 0; axis < 3; ++axis) d[static_cast<std::size_t>(axis)] = way<order>(first, second, from, p_j, axis);
  SpanMeasures<order> span;
  span.length = sqrt(square(d[0]) + square(d[1]) + square(d[2]) - difference * difference);
  const double l = span.length.value, squared = l * l + difference * difference;
  // gamma = atan2(difference, l): d gamma/dl = -difference/(l^2 + difference^2)
  const auto gamma =
      compose(span.length, std::atan2(difference, l), -difference / squared, 2 * l * difference / (squared * squared));
  if (from.radius != 0) span.first_turn = atan2(d[1], d[0]) + gamma;
  if (to.radius != 0) {
    // The vector from j to i, reversed.
    const auto x = exchanged<order>(-way<order>(second, first, to, p_i, 0)),
               y = exchanged<order>(-way<order>(second, first, to, p_i, 1));
    span.second_turn = atan2(y, x) + gamma;
  }
  return span;
}

template SpanMeasures<1> measure_span(const NodeState&, const NodeState&, const Pulley&, const Pulley&);
template SpanMeasures<2> measure_span(const NodeState&, const NodeState&, const Pulley&, const Pulley&);

}  // namespace bielle::mechanism
