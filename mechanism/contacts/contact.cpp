#include "mechanism/contacts/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr double apart = -1;  ///< takes the place of the damping of a pair that is apart

}  // namespace

Contact::Contact(std::string name, std::vector<ContactShape> shapes, std::vector<std::pair<int, int>> pairs,
                 SurfaceLaw law)
    : Component("contact", std::move(name)),
      shapes_(std::move(shapes)),
      pairs_(std::move(pairs)),
      law_(std::move(law)),
      frictionless_{law_.normal, {}, {}},
      near_pairs_(static_cast<int>(shapes_.size()), pairs_),
      thinnest_(std::numeric_limits<double>::infinity()) {
  for (const ContactShape& shape : shapes_) {
    const auto known = std::find(nodes_.begin(), nodes_.end(), shape.node);
    local_node_.push_back(static_cast<int>(known - nodes_.begin()));
    if (known == nodes_.end()) nodes_.push_back(shape.node);
  }
  std::vector<bool> is_first(shapes_.size(), false), is_second(shapes_.size(), false);
  for (const auto& [a, b] : pairs_)
    is_first[static_cast<std::size_t>(a)] = is_second[static_cast<std::size_t>(b)] = true;
  // In a heap, each body touches about ten others; two boxes may touch at up to 16 corners, and at edges.
  if (has_bristles()) most_bristles_ = 32 * static_cast<Eigen::Index>(std::min(pairs_.size(), 2 * shapes_.size()));
  for (std::size_t k = 0; k < shapes_.size(); ++k) divided_ = divided_ && !(is_first[k] && is_second[k]);
  for (const auto& [a, b] : pairs_) thinnest_ = std::min(thinnest_, passage(a, b));
}

void Contact::declare(Declaration& declaration) const {
  declaration.nodes = nodes_;
  declaration.stiffness = declaration.in_blocks = declaration.kinks = true;
  declaration.damping = law_.friction || law_.rolling || law_.normal.damping > 0 || remembers_touches();
  declaration.memory.assign(1 + 3 * shapes_.size(), std::numeric_limits<double>::quiet_NaN());
  if (remembers_touches()) declaration.memory.resize(declaration.memory.size() + pairs_.size(), apart);
  if (has_bristles())
    declaration.memory.resize(
        declaration.memory.size() + static_cast<std::size_t>(12 * static_cast<Eigen::Index>(nodes_.size()) + 1 +
                                                             bristle_entry * most_bristles_),
        0);
  if (!remembers_touches()) return;
  EventFunction touches{"touches", EventFunction::Direction::falling};
  touches.restarts = false;  // forces begin at zero
  declaration.event_functions = {touches};
}

PairForce Contact::force_of(const LocalState& state, int pair) const {
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  return {shape(a), shape(b), state.node(local_node(a)), state.node(local_node(b))};
}

/// Returns the result of act(force of the pair). Errors are rethrown with the pair and the time.
template <class Act>
auto Contact::of_pair(const LocalState& state, int pair, const Act& act) const {
  try {
    return act(force_of(state, pair));
  } catch (const ComputationError& error) {
    throw ComputationError(
        fmt::format("contact '{}' at t = {:.6g} s: {}: {}", name(), state.time(), pair_name(pair), error.what()));
  }
}

PairForce::Result Contact::acting(const LocalState& state, int pair) const {
  return of_pair(state, pair, [&](const PairForce& force) {
    return force.calc(law_of(state), damping(state, pair), bristles(state, pair));
  });
}

PairForce::Nearest Contact::nearest(const LocalState& state, int pair) const {
  return of_pair(state, pair, [](const PairForce& force) { return force.nearest(); });
}

double Contact::damping(const LocalState& state, int pair) const {
  if (!remembers_touches()) return law_.normal.damping;
  if (state.environment().statics) return 0;
  return std::max(0.0, state.memory()[dampings_begin() + pair]);
}

const Bristles& Contact::bristles(const LocalState& state, int pair) const {
  thread_local Bristles found;
  found.before.clear();
  if (!has_bristles()) return found;
  const auto memory = state.memory();
  found.known = !std::isnan(memory[0]);
  if (!found.known) return found;
  const auto x = [&](int node) { return Vector3(memory.segment<3>(bristles_begin() + 12 * node)); };
  const auto R = [&](int node) {
    return Matrix3(Eigen::Map<const Matrix3>(memory.data() + bristles_begin() + 12 * node + 3));
  };
  const auto [a, b] = nodes_of(pair);
  found.s = R(a).transpose() * (x(b) - x(a));
  found.R_12 = R(a).transpose() * R(b);
  const Eigen::Index begin = bristle_count();
  const auto count = static_cast<Eigen::Index>(memory[begin]);
  const auto entry = [&](Eigen::Index k) { return begin + 1 + bristle_entry * k; };
  Eigen::Index first = 0;
  for (Eigen::Index end = count; first < end;) {
    const Eigen::Index middle = (first + end) / 2;
    if (memory[entry(middle)] < pair)
      first = middle + 1;
    else
      end = middle;
  }
  for (Eigen::Index k = first; k < count && memory[entry(k)] == pair; ++k)
    found.before.push_back(
        {static_cast<int>(memory[entry(k) + 1]), memory.segment<3>(entry(k) + 2), memory.segment<3>(entry(k) + 5)});
  return found;
}

bool Contact::knows_memory(const LocalState& state) const {
  if (!has_bristles()) return true;
  const auto memory = state.memory();
  const auto whole_within = [&](Eigen::Index k, double most) {
    return memory[k] >= 0 && memory[k] <= most && memory[k] == std::floor(memory[k]);
  };
  const Eigen::Index begin = bristle_count();
  if (!whole_within(begin, static_cast<double>(most_bristles_))) return false;
  constexpr double most_places = std::numeric_limits<int>::max();
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(memory[begin]); ++k)
    if (const Eigen::Index entry = begin + 1 + bristle_entry * k;
        !whole_within(entry, static_cast<double>(pairs_.size() - 1)) || !(std::abs(memory[entry + 1]) <= most_places))
      return false;
  return true;
}

void Contact::remember_bristles(const LocalState& state, const std::vector<int>& near,
                                Eigen::Ref<VectorX> memory) const {
  for (int k = 0; k < static_cast<int>(nodes_.size()); ++k) {
    memory.segment<3>(bristles_begin() + 12 * k) = state.node(k).x;
    Eigen::Map<Matrix3>(memory.data() + bristles_begin() + 12 * k + 3) = state.node(k).R;
  }
  const Eigen::Index begin = bristle_count();
  thread_local std::vector<Bristle> now;
  Eigen::Index count = 0;
  for (const int pair : near) {
    now.clear();
    of_pair(state, pair, [&](const PairForce& force) {
      force.add_bristles(law_of(state), bristles(state, pair), now);
      return 0;
    });
    for (const Bristle& each : now) {
      if (count == most_bristles_)
        throw ComputationError(
            fmt::format("contact '{}' at t = {:.6g} s: more than {} places touch, as many as can have "
                        "bristles; take `model: coulomb`, or several contacts",
                        name(), state.time(), most_bristles_));
      const Eigen::Index at = begin + 1 + bristle_entry * count++;
      memory[at] = pair;
      memory[at + 1] = each.id;
      memory.segment<3>(at + 2) = each.z;
      memory.segment<3>(at + 5) = each.place;
    }
  }
  memory[begin] = static_cast<double>(count);
}

Vector3 Contact::middle(const LocalState& state, int k) const {
  const NodeState& node = state.node(local_node(k));
  return node.x + node.R * shape(k).frame.x;
}

/// Returns the bounds of the shapes. The reference is valid until the next call in the same thread.
const std::vector<NearPairs::Bound>& Contact::bounds(const LocalState& state) const {
  thread_local std::vector<NearPairs::Bound> bounds;
  bounds.resize(shapes_.size());
  for (int k = 0; k < static_cast<int>(shapes_.size()); ++k)
    bounds[static_cast<std::size_t>(k)] = {middle(state, k), shape(k).reach(),
                                           state.node(local_node(k)).R * shape(k).frame.R.col(2)};
  return bounds;
}

void Contact::find_near(const LocalState& state, std::vector<int>& pairs) const {
  near_pairs_.find(bounds(state), pairs);
}

void Contact::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  check_passage(state);
  thread_local std::vector<int> near;
  find_near(state, near);
  for (const int pair : near) {
    const Vector12 part = acting(state, pair).r;
    const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
    r.segment<6>(6 * local_node(a)) += part.head<6>();
    r.segment<6>(6 * local_node(b)) += part.tail<6>();
  }
}

namespace {

/// Adds the derivatives of pairs to the local matrices of a component.
class LocalPairs final : public PairDerivatives {
 public:
  explicit LocalPairs(LocalTangent& tangent) : tangent_(tangent) {}
  void add(int a, int b, const Vector12& /*r*/, const Matrix12& K, const Matrix12& C) override {
    const std::array<int, 4> at = {6 * a, 6 * a + 3, 6 * b, 6 * b + 3};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const int row = at[static_cast<std::size_t>(i)], column = at[static_cast<std::size_t>(j)];
        if (tangent_.wants_K) tangent_.K.add(row, column, Matrix3(K.block<3, 3>(3 * i, 3 * j)));
        if (tangent_.wants_C) tangent_.C.add(row, column, Matrix3(C.block<3, 3>(3 * i, 3 * j)));
      }
  }

 private:
  LocalTangent& tangent_;
};

}  // namespace

void Contact::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  LocalPairs pairs(tangent);
  add_pair_tangents(state, pairs);
}

void Contact::add_pair_tangents(const LocalState& state, PairDerivatives& sum) const {
  thread_local std::vector<int> near;
  find_near(state, near);
  Matrix12 K, C;
  for (const int pair : near) {
    const PairForce::Result result = acting(state, pair);
    if (result.depth <= 0) continue;
    calc_tangent_of(state, pair, K, C);
    const auto [a, b] = nodes_of(pair);
    sum.add(a, b, result.r, K, C);
  }
}

void Contact::add_near_nodes(const LocalState& state, std::vector<std::pair<int, int>>& near) const {
  // Pairs nearer than this part of their sizes have entries in the tangent before they touch.
  constexpr double margin = 0.25;
  std::vector<NearPairs::Bound> wider = bounds(state);
  for (NearPairs::Bound& each : wider) each.reach *= 1 + margin;
  std::vector<int> pairs;
  near_pairs_.find(wider, pairs);
  for (const int pair : pairs) {
    const auto [a, b] = nodes_of(pair);
    near.emplace_back(a, b);
  }
}

void Contact::add_energy(const LocalState& state, Energy& energy) const {
  thread_local std::vector<int> near;
  find_near(state, near);
  for (const int pair : near) {
    const PairForce::Result result = acting(state, pair);
    energy.elastic += result.elastic;
    energy.dissipation += result.dissipation;
    energy.input += result.input;
  }
}

/// Pairs whose bounding spheres are farther apart than the smallest gap so far are skipped. If gaps are equal,
/// the first pair is taken.
Contact::NearestPair Contact::nearest_of_all(const LocalState& state, bool apart_only) const {
  const Vector3 nowhere = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  NearestPair all{-1, {1e300, 0, nowhere, nowhere}};
  const auto take = [&](int pair) {
    if (apart_only && state.memory()[dampings_begin() + pair] != apart) return;
    const PairForce::Nearest found = nearest(state, pair);
    if (found.gap < all.found.gap || (found.gap == all.found.gap && pair < all.pair)) all = {pair, found};
  };
  near_pairs_.for_each_within(bounds(state), all.found.gap, take);
  return all;
}

/// Returns a clause on open shapes. For a single pair it gives the gap; for a group, the shapes that touch nothing.
std::string Contact::what_is_open(const LocalState& state) const {
  std::vector<bool> touches(shapes_.size(), false);
  bool any = false;
  for_each_touching(state, [&](int pair, const Vector3&) {
    const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
    any = touches[static_cast<std::size_t>(a)] = touches[static_cast<std::size_t>(b)] = true;
  });
  if (!any) return fmt::format("is open, its shapes are {:.3g} m apart", nearest_of_all(state).found.gap);
  std::string open;
  int count = 0;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    if (touches[k]) continue;
    if (++count <= 3)
      open += fmt::format("{}{} on '{}'", count == 1 ? "" : ", ", shapes_[k].kind_name(), shapes_[k].node_name);
  }
  if (count == 0) return {};
  return fmt::format("is open at {}{}, which touch{} nothing", open,
                     count > 3 ? fmt::format(" and {} more", count - 3) : "", count == 1 ? "es" : "");
}

std::vector<OutputField> Contact::output_fields() const {
  const bool two = shapes_.size() == 2;
  return {{"gap", {}, "m", "smallest distance of the surfaces; negative: how deep they press into each other"},
          {"force", two ? std::vector<std::size_t>{3} : std::vector<std::size_t>{shapes_.size(), 3}, "N",
           two ? "on the second shape, inertial components" : "on each shape, inertial components"},
          {"state", {}, "", "number of pairs of shapes that touch"},
          {"point", {3}, "m", "where the smallest gap is: halfway between the surfaces, inertial"}};
}

void Contact::write_output(const LocalState& state, double* values) const {
  const std::size_t forces = shapes_.size() == 2 ? 1 : shapes_.size();
  std::fill_n(values, 2 + 3 * forces, 0.0);
  thread_local std::vector<int> near;
  find_near(state, near);
  double& touching = values[1 + 3 * forces];
  for (const int pair : near) {
    const PairForce::Result result = acting(state, pair);
    if (result.depth <= 0) continue;
    ++touching;
    const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
    if (forces > 1) Eigen::Map<Vector3>(values + 1 + 3 * a) -= result.force;
    Eigen::Map<Vector3>(values + 1 + (forces > 1 ? 3 * b : 0)) += result.force;
  }
  const PairForce::Nearest smallest = nearest_of_all(state).found;
  values[0] = smallest.gap;
  Eigen::Map<Vector3>(values + 2 + 3 * forces) = smallest.place;
}

void Contact::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values[0] = nearest_of_all(state, true).found.gap;
}

void Contact::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const { remember(state, memory); }

void Contact::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                           Eigen::Ref<VectorX> memory) const {
  remember(state, memory);
}

void Contact::remember(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  memory[0] = state.time();
  for (int k = 0; k < static_cast<int>(shapes_.size()); ++k) memory.segment<3>(1 + 3 * k) = middle(state, k);
  const Eigen::Index dampings = dampings_begin();
  if (remembers_touches()) memory.segment(dampings, bristles_begin() - dampings).setConstant(apart);
  thread_local std::vector<int> near;
  find_near(state, near);
  for (const int pair : near) {
    const PairForce::Nearest found = nearest(state, pair);
    check_depth(state, pair, found);
    if (!remembers_touches()) continue;
    const bool touches = found.gap < 0 || (found.gap == 0 && found.rate <= 0);
    if (!touches) continue;
    const double before = state.memory()[dampings + pair];
    memory[dampings + pair] = before != apart ? before : law_.normal.damping_after(std::max(0.0, -found.rate));
  }
  if (has_bristles()) remember_bristles(state, near, memory);
}

std::string Contact::shape_name(int k) const {
  return fmt::format("{} on '{}'", shape(k).kind_name(), shape(k).node_name);
}

std::string Contact::pair_name(int pair) const {
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  return fmt::format("{} and {}", shape_name(a), shape_name(b));
}

void Contact::describe(const LocalState& state, Description& description) const {
  constexpr std::size_t most = 10;
  if (shapes_.size() > 2)
    description.add(fmt::format("{} shapes, {} pairs that may touch", shapes_.size(), pairs_.size()));
  for (std::size_t k = 0; k < std::min(most, shapes_.size()); ++k) description.add_line(shapes_[k].describe());
  if (shapes_.size() > most) description.add_line(fmt::format("and {} more shapes", shapes_.size() - most));
  description.add(law_.normal.describe());
  if (law_.friction) description.add(law_.friction->describe());
  if (law_.rolling)
    description.add(fmt::format("rolling resistance with an arm of {:.6g} m, smooth within {:.6g} rad/s",
                                law_.rolling->kinetic, law_.rolling->velocity));
  description.add(fmt::format("smallest gap {:.6g} m", nearest_of_all(state).found.gap));
}

}  // namespace bielle::mechanism
