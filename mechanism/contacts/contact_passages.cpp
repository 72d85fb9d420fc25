// Detects pairs that pass through each other between two accepted steps without touching at either: the displacement of
// one shape relative to the other since the last accepted step is checked in parts of a quarter of their thickness.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/contacts/contact.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

PairForce::Nearest Contact::nearest_before(const LocalState& state, int pair, const Vector3& way) const {
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  NodeState second = state.node(local_node(b));
  second.x -= way;
  return PairForce(shape(a), shape(b), state.node(local_node(a)), second).nearest();
}

void Contact::check_passage(const LocalState& state) const {
  if (state.environment().statics || std::isinf(thinnest_)) return;
  const auto memory = state.memory();
  if (!(state.time() > memory[0])) return;  // also true if the time is NaN
  double farthest = 0;
  const double passed = state.time() - memory[0];
  // Upper bound of the displacement of a shape's surface by rotation about its middle; a sphere is invariant.
  const auto turned = [&](int k) {
    const double lever = shape(k).reach() - shape(k).thickness() / 2;
    return std::isfinite(lever) ? passed * std::max(0.0, lever) * state.node(local_node(k)).Omega.norm() : 0.0;
  };
  thread_local std::vector<double> moved;
  moved.clear();
  for (int k = 0; k < static_cast<int>(shapes_.size()); ++k) {
    moved.push_back((middle(state, k) - memory.segment<3>(1 + 3 * k)).norm() + turned(k));
    farthest = std::max(farthest, moved.back());
  }
  if (4 * farthest <= thinnest_) return;
  // Only shapes whose bounds touch, enlarged by their displacements, can have met.
  thread_local std::vector<NearPairs::Bound> swept;
  thread_local std::vector<int> met;
  swept = bounds(state);
  for (std::size_t k = 0; k < swept.size(); ++k) swept[k].reach += moved[k];
  near_pairs_.find(swept, met);
  for (const int pair : met) {
    const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
    const double thickness = passage(a, b);
    const Vector3 now = middle(state, b) - middle(state, a);
    const Vector3 way = now - (memory.segment<3>(1 + 3 * b) - memory.segment<3>(1 + 3 * a));
    const double turn = turned(a) + turned(b);
    if (!(way.norm() + turn > 0.5 * thickness)) continue;
    const double share = std::clamp(now.dot(way) / way.squaredNorm(), 0.0, 1.0);
    if (!((now - share * way).norm() < shape(a).reach() + shape(b).reach() + turn)) continue;
    has_surface(a, b) ? check_passage_of_surface(state, pair, way) : check_passage_of(state, pair, way, turn);
  }
}

bool Contact::has_surface(int a, int b) const {
  // A half-space is solid everywhere below.
  if (std::isinf(shape(a).thickness()) || std::isinf(shape(b).thickness())) return false;
  return shape(a).kind == ContactShape::Kind::surface || shape(b).kind == ContactShape::Kind::surface;
}

double Contact::passage(int a, int b) const {
  if (has_surface(a, b)) return shape(a).skin() + shape(b).skin();
  return shape(a).thickness() + shape(b).thickness();
}

/// Checks that a shape has not passed through the skin of a surface: only the skin is known to be solid, and a deeper
/// shape in a trial state would not touch it.
/// @param way  displacement, as in check_passage_of
void Contact::check_passage_of_surface(const LocalState& state, int pair, const Vector3& way) const {
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  const PairForce::Nearest now = nearest_before(state, pair, Vector3::Zero());
  check_depth(state, pair, now);
  if (now.gap < 0) return;  // the pair touches, and has a force
  const double parts = std::min(1000.0, std::ceil(4 * way.norm() / passage(a, b)));
  for (double k = 1; k <= parts; ++k)
    if (nearest_before(state, pair, k / parts * way).gap < 0) fail_passage(state, pair, way);
}

void Contact::fail_passage(const LocalState& state, int pair, const Vector3& way) const {
  throw ComputationError(
      fmt::format("contact '{}' at t = {:.6g} s: {} pass through each other within one step, {:.3g} m in {:.3g} s",
                  name(), state.time(), pair_name(pair), way.norm(), state.time() - state.memory()[0]));
}

/// @param way  displacement of the second shape relative to the first, since the last accepted step
/// @param turn  largest displacement of their surfaces by rotation since then [m]
void Contact::check_passage_of(const LocalState& state, int pair, const Vector3& way, double turn) const {
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  const auto gap = [&](double share) { return nearest_before(state, pair, share * way).gap; };
  const auto presses = [&](double share) { return gap(share) < 0; };
  const double thickness = shape(a).thickness() + shape(b).thickness();
  // Shapes in contact might otherwise separate on the far side, and rotating shapes might pass each other unnoticed.
  const bool may_turn_over = turn > 0.25 * thickness && std::min(gap(0), gap(1)) < turn;
  if (presses(0) || presses(1) || may_turn_over)
    throw ComputationError(
        fmt::format("contact '{}' at t = {:.6g} s: {} move by {:.3g} m in {:.3g} s where they touch, more than half "
                    "their thickness",
                    name(), state.time(), pair_name(pair), way.norm() + turn, state.time() - state.memory()[0]));
  const double parts = std::min(1000.0, std::ceil(4 * way.norm() / thickness));
  for (double k = 1; k < parts; ++k)
    if (presses(k / parts)) fail_passage(state, pair, way);
}

}  // namespace bielle::mechanism
