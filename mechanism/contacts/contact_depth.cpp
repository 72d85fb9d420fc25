// Detects shapes that penetrate deeper than the depth up to which the outward direction is determined, and shapes that
// overlap in their drawn positions.
#include <algorithm>

#include <fmt/format.h>

#include "mechanism/contacts/contact.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

/// Returns the height of the middle of a shape over a plane [m].
double Contact::height_of_middle(const LocalState& state, int plane, int other) const {
  const NodeState &of_plane = state.node(local_node(plane)), &of_other = state.node(local_node(other));
  const Frame &P = shape(plane).frame, &O = shape(other).frame;
  const Vector3 normal = of_plane.R * P.R.col(2);
  return normal.dot(of_other.x + of_other.R * (O.x + O.R * shape(other).middle()) - of_plane.x - of_plane.R * P.x);
}

/// @throws ComputationError if the penetration does not determine the outward direction any more
void Contact::check_depth(const LocalState& state, int pair, const PairForce::Nearest& found) const {
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  // A plane always has an outward direction; a shape whose middle is behind it has passed through it.
  for (const auto& [plane, other] : {std::pair(a, b), std::pair(b, a)}) {
    if (shape(plane).kind != ContactShape::Kind::plane) continue;
    const double behind = -height_of_middle(state, plane, other);
    if (behind > 0)
      throw ComputationError(fmt::format(
          "contact '{}' at t = {:.6g} s: {} has gone through {} with its middle, which is {:.3g} m behind it; make the "
          "contact stiffer",
          name(), state.time(), shape_name(other), shape_name(plane), behind));
    return;
  }
  const double most = shape(a).skin() + shape(b).skin();
  if (-found.gap > most)
    throw ComputationError(
        fmt::format("contact '{}' at t = {:.6g} s: {} press {:.3g} m into each other, beyond the {:.3g} m up to which "
                    "the direction of the contact force is known; make the contact stiffer, or `rounding` larger",
                    name(), state.time(), pair_name(pair), -found.gap, most));
  if (-found.gap > 0.5 * most && has_turned_over(state, pair, found))
    throw ComputationError(fmt::format(
        "contact '{}' at t = {:.6g} s: {} have gone through each other's middle, where they would press {:.3g} m into "
        "each other; make the contact stiffer",
        name(), state.time(), pair_name(pair), most));
}

/// Returns whether the normal has reversed since the last accepted step. Only this shows that lines or points have
/// passed through each other, since they have no interior.
bool Contact::has_turned_over(const LocalState& state, int pair, const PairForce::Nearest& found) const {
  const auto memory = state.memory();
  if (!(state.time() > memory[0])) return false;
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  const Vector3 way =
      middle(state, b) - middle(state, a) - (memory.segment<3>(1 + 3 * b) - memory.segment<3>(1 + 3 * a));
  return nearest_before(state, pair, way).normal.dot(found.normal) < 0;
}

std::pair<std::string, double> Contact::drawn_into_each_other(const Model& model) const {
  const auto drawn = [&](int k) {
    NodeState node;
    node.x = model.node(shape(k).node).frame.x;
    node.R = model.node(shape(k).node).frame.R;
    return node;
  };
  double deepest = 0, share = 0;
  int deepest_pair = -1;
  std::vector<NodeState> nodes;
  std::vector<NearPairs::Bound> bounds;
  for (int k = 0; k < static_cast<int>(shapes_.size()); ++k) {
    nodes.push_back(drawn(k));
    bounds.push_back({nodes.back().x + nodes.back().R * shape(k).frame.x, shape(k).reach(),
                      nodes.back().R * shape(k).frame.R.col(2)});
  }
  std::vector<int> near;
  near_pairs_.find(bounds, near);
  for (const int pair : near) {
    const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
    const PairForce force(shape(a), shape(b), nodes[static_cast<std::size_t>(a)], nodes[static_cast<std::size_t>(b)]);
    double depth = 0;
    try {
      depth = -force.nearest().gap;
    } catch (const ComputationError& error) {
      throw InputError(fmt::format("{}: {}", pair_name(pair), error.what()));
    }
    if (depth <= deepest) continue;
    deepest = depth;
    deepest_pair = pair;
    const double least = std::min(shape(a).thickness(), shape(b).thickness());
    share = depth / (least > 0 ? least : std::max(shape(a).thickness(), shape(b).thickness()));
  }
  if (deepest_pair < 0) return {};
  return {fmt::format("{} are drawn into each other by {:.3g} m", pair_name(deepest_pair), deepest), share};
}

}  // namespace bielle::mechanism
