#include "mechanism/solvers/statics/node_motion.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

constexpr double small_displacement = 1e-3;  // relative to the mechanism's size
constexpr double small_turn = 1e-2;          // [rad]
constexpr double told_positions = 1e-9;      // relative to the distance of nodes from the origin
constexpr double trapezoid = 0.2, change = 1;
constexpr double share = 0.05;  // fraction of the largest motion that is the reference for nodes with a smaller motion

}  // namespace

State displaced(const System& system, const State& base, double motion, const VectorX& delta) {
  State state = base;
  state.motion_factor = motion;
  system.displace(state, base, delta.head(system.dofs()));
  state.first_order = base.first_order + delta.segment(system.dofs(), system.first_orders());
  state.multiplier = base.multiplier + delta.tail(system.multipliers());
  return state;
}

NodeMotions motions_along(const System& system, const State& base, const VectorX& delta, double motion) {
  // The difference is taken over a fraction that is short enough for rotations and prescribed motions to be linear in
  // it.
  constexpr double straight = 1e-4;
  double turn = motion != 0 ? 1 : 0;
  for (int i = 0; i < system.dofs(); ++i)
    if (system.kind(i) == Kind::rotation) turn = std::max(turn, std::abs(delta[i]));
  const double part = turn > straight ? straight / turn : 1;
  State moved = base;
  moved.motion_factor = base.motion_factor + part * motion;
  system.displace(moved, base, part * delta.head(system.dofs()));
  NodeMotions motions = motions_between(base, moved);
  for (NodeMotion& node : motions) {
    node.displacement /= part;
    node.turn /= part;
  }
  return motions;
}

NodeMotions motions_between(const State& from, const State& to) {
  NodeMotions motions(from.nodes.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const NodeState &a = from.nodes[i], &b = to.nodes[i];
    motions[i].displacement = b.x - a.x;
    motions[i].turn = a.R * log_so3(Matrix3(a.R.transpose() * b.R));
  }
  return motions;
}

IncrementMeasure::IncrementMeasure(const State& state)
    : displacement_(std::max(small_displacement * model_extent(state), told_positions * model_length(state))) {}

bool IncrementMeasure::small(const NodeMotions& motion) const {
  return std::all_of(motion.begin(), motion.end(), [&](const NodeMotion& node) {
    return node.displacement.norm() <= displacement_ && node.turn.norm() <= small_turn;
  });
}

double IncrementMeasure::bend(const NodeMotions& begin, const NodeMotions& end, const NodeMotions& found) const {
  double bend = 0;
  const auto judge = [&](Vector3 NodeMotion::*part, double small) {
    double largest = 0;
    for (const NodeMotion& node : found) largest = std::max(largest, (node.*part).norm());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Vector3 &d0 = begin[i].*part, &d1 = end[i].*part, &d = found[i].*part;
      const double size = std::max({d.norm(), share * largest, small});
      const double missed = (d - 0.5 * (d0 + d1)).norm(), changed = (d1 - d0).norm();
      if (missed > small) bend = std::max(bend, missed / (trapezoid * size));
      if (changed > small) bend = std::max(bend, changed / (change * size));
      if (!std::isfinite(missed + changed)) bend = INFINITY;
    }
  };
  judge(&NodeMotion::displacement, displacement_);
  judge(&NodeMotion::turn, small_turn);
  return bend;
}

double IncrementMeasure::unsettled(const NodeMotions& correction, const NodeMotions& second) const {
  constexpr double half = 0.5;
  double ratio = 0;
  const auto judge = [&](Vector3 NodeMotion::*part, double small) {
    double first = small, left = 0;
    for (const NodeMotion& node : correction) first = std::max(first, (node.*part).norm());
    for (const NodeMotion& node : second) left = std::max(left, (node.*part).norm());
    if (left > small || !std::isfinite(left)) ratio = std::max(ratio, left / (half * first));
  };
  judge(&NodeMotion::displacement, displacement_);
  judge(&NodeMotion::turn, small_turn);
  return std::isfinite(ratio) ? ratio : INFINITY;
}

}  // namespace bielle::mechanism
