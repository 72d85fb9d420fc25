#include "mechanism/system/tangent_assembly.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "mechanism/system/sparse_columns.hpp"

namespace bielle::mechanism {

/// One bit for each reduced entry of each member, which is set if the entry belongs to the pattern.
class TangentAssembly::KeptEntries {
 public:
  KeptEntries(const TangentAssembly& assembly) : placements_(assembly.placements_) {
    first_multiplier_ = assembly.unknowns_.first_multiplier();
    begin_.reserve(placements_.size() + 1);
    for (std::size_t m = 0; m < placements_.size(); ++m) {
      begin_.push_back(kept_.size());
      if (placements_[m].contributes() && !assembly.pairs_of(m))
        add(m, placements_[m].pattern(*assembly.model_.members()[m].component, assembly.unknowns_.slots()[m]));
    }
    begin_.push_back(kept_.size());
  }
  /// Calls act(entry, row, column) for each kept entry: its index among the member's own, by columns, and its global
  /// row and column.
  template <class Act>
  void for_each(std::size_t member, const Act& act) const {
    const std::vector<int>& unknown = placements_[member].unknown;
    std::size_t k = begin_[member];
    if (k == begin_[member + 1]) return;
    int entry = 0;
    for (const int column : unknown)
      for (const int row : unknown) {
        if (kept_[k++]) act(entry, row, column);
        ++entry;
      }
  }

 private:
  /// Adds a member's entries. A constraint does not depend on multipliers: that block is not in the pattern, except the
  /// diagonal entries of constraints that may be out of the equations. No component adds to the constraints of others.
  void add(std::size_t member, const LocalPattern& pattern) {
    const LocalToGlobal& placement = placements_[member];
    const int n = placement.reduced_size();
    std::vector<bool> of_others(placement.reads_multipliers ? static_cast<std::size_t>(n) : 0, false);
    if (placement.reads_multipliers)
      for (const ScalarPart& part : placement.scalars)
        if (part.kind == Kind::multiplier && !part.own) std::fill_n(of_others.begin() + part.reduced, part.count, true);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int row = placement.unknown[static_cast<std::size_t>(i)],
                  column = placement.unknown[static_cast<std::size_t>(j)];
        const bool constraint = row >= first_multiplier_;
        kept_.push_back(pattern.has(i, j) && row >= 0 && column >= 0 && !(constraint && column >= first_multiplier_) &&
                        !(placement.reads_multipliers && of_others[static_cast<std::size_t>(i)]));
      }
  }

  const std::vector<LocalToGlobal>& placements_;
  int first_multiplier_;
  std::vector<bool> kept_;
  std::vector<std::size_t> begin_;  ///< first bit of each member, and the end
};

void TangentAssembly::complete() {
  for (std::size_t m = 0; m < placements_.size(); ++m) {
    const Slots& slots = unknowns_.slots()[m];
    placements_[m].find_rows(kinematics_, unknowns_, slots);
    const auto* coupled = dynamic_cast<const CoupledPairs*>(model_.members()[m].component.get());
    number_of_pairs_.push_back(coupled ? static_cast<int>(pairs_.size()) : -1);
    if (!coupled) {
      largest_local_ = std::max(largest_local_, slots.size());
      continue;
    }
    pairs_.emplace_back(*coupled, kinematics_, slots);
    pairs_member_.push_back(m);
  }
  for (std::size_t m = 0; m < placements_.size(); ++m) {
    const Slots& slots = unknowns_.slots()[m];
    if (unknowns_.activities().is_governed(m))
      for (int k = 0; k < slots.first_orders; ++k)
        held_when_released_.push_back(unknowns_.first_first_order() + slots.first_order_begin + k);
  }
  find_lone_amplitudes();
}

void TangentAssembly::find_lone_amplitudes() {
  std::vector<bool> referred(static_cast<std::size_t>(unknowns_.amplitudes()), false);
  const auto first = [&](const ScalarPart& part) {
    return referred.begin() + part.unknown - unknowns_.first_amplitude();
  };
  for (const LocalToGlobal& placement : placements_)
    if (placement.contributes())
      for (const ScalarPart& part : placement.scalars)
        if (part.kind == Kind::amplitude && !part.own) std::fill_n(first(part), part.count, true);
  for (LocalToGlobal& placement : placements_) {
    const ScalarPart* own = placement.contributes() ? placement.own_amplitudes() : nullptr;
    placement.lone_amplitudes =
        own && std::find(first(*own), first(*own) + own->count, true) == first(*own) + own->count;
  }
}

std::vector<std::vector<int>> TangentAssembly::lone_amplitudes() const {
  std::vector<std::vector<int>> all;
  for (const LocalToGlobal& placement : placements_) {
    if (!placement.lone_amplitudes) continue;
    const ScalarPart& part = *placement.own_amplitudes();
    std::vector<int>& amplitudes = all.emplace_back(static_cast<std::size_t>(part.count));
    std::iota(amplitudes.begin(), amplitudes.end(), part.unknown);
  }
  return all;
}

void TangentAssembly::build_pattern(const std::vector<bool>& may_be_idle) {
  may_be_idle_ = may_be_idle;
  build_pattern();
}

bool TangentAssembly::forget_pairs() {
  if (std::all_of(pairs_.begin(), pairs_.end(), [](const PairTangents& each) { return each.count() == 0; }))
    return false;
  for (PairTangents& each : pairs_) each.forget();
  build_pattern();
  return true;
}

void TangentAssembly::build_pattern() {
  const KeptEntries kept(*this);
  SparsePattern pattern = gather_columns(unknowns_.size(), [&](const auto& act) {
    for (std::size_t m = 0; m < placements_.size(); ++m)
      kept.for_each(m, [&](int, int row, int column) { act(row, column); });
    for (const PairTangents& each : pairs_) each.for_each_entry([&](int row, int column, bool) { act(row, column); });
    for (int i = 0; i < unknowns_.dofs(); ++i) act(i, i);  // solvers add values to the diagonal
    for (const int i : held_when_released_) act(i, i);
    for (int k = 0, row = unknowns_.first_multiplier(); row < unknowns_.size(); ++k, ++row)
      if (may_be_idle_[static_cast<std::size_t>(k)]) act(row, row);
  });
  find_intermittent(kept, pattern);
  pattern_ = std::make_shared<const TangentPattern>(std::move(pattern), lone_amplitudes());
  small_.clear();
  for (std::size_t m = 0; m < placements_.size(); ++m) {
    if (number_of_pairs_[m] < 0)
      set_places(kept, m);
    else
      small_.push_back(m);
  }
  for (PairTangents& each : pairs_) each.find_places(pattern_->whole);
  waiting_.assign(1, 0);
  for (const std::size_t m : work_.costly()) waiting_.push_back(waiting_.back() + placements_[m].targets.count());
}

/// Finds the global entries that are zero most of the time: those to which only pairs contribute, apart from the
/// diagonal.
void TangentAssembly::find_intermittent(const KeptEntries& kept, SparsePattern& pattern) const {
  if (pairs_.empty()) return;
  std::vector<char> lasts(static_cast<std::size_t>(pattern.entry_count()), 0);
  const auto last = [&](int row, int column) { lasts[static_cast<std::size_t>(pattern.find(row, column))] = 1; };
  for (std::size_t m = 0; m < placements_.size(); ++m)
    kept.for_each(m, [&](int, int row, int column) { last(row, column); });
  for (const PairTangents& each : pairs_)
    each.for_each_entry([&](int row, int column, bool lasting) {
      if (lasting) last(row, column);
    });
  for (int i = 0; i < unknowns_.dofs(); ++i) last(i, i);
  for (const int i : held_when_released_) last(i, i);
  for (std::size_t k = 0; k < may_be_idle_.size(); ++k)
    if (may_be_idle_[k])
      last(unknowns_.first_multiplier() + static_cast<int>(k), unknowns_.first_multiplier() + static_cast<int>(k));
  std::vector<int> intermittent;
  for (std::size_t k = 0; k < lasts.size(); ++k)
    if (!lasts[k]) intermittent.push_back(static_cast<int>(k));
  pattern.set_intermittent(std::move(intermittent));
}

void TangentAssembly::set_places(const KeptEntries& kept, std::size_t member) {
  std::vector<Targets::Target> targets;
  const SparsePattern& pattern = pattern_->whole;
  const std::vector<int>& rows = pattern.row();
  int place = -1;
  kept.for_each(member, [&](int entry, int row, int column) {
    // Consecutive rows are frequent.
    const bool follows = place >= 0 && place + 1 < pattern.column_start()[static_cast<std::size_t>(column) + 1] &&
                         place >= pattern.column_start()[static_cast<std::size_t>(column)] &&
                         rows[static_cast<std::size_t>(place) + 1] == row;
    place = follows ? place + 1 : pattern.find(row, column);
    targets.push_back({entry, place});
  });
  placements_[member].set_places(kinematics_, unknowns_.slots()[member], targets);
  if (!targets.empty() && !work_.is_costly(member)) small_.push_back(member);
}

/// Adds each block directly to its places.
void TangentAssembly::add_in_place(const LocalToGlobal& placement, const LocalState& local,
                                   const TangentWeights& weights, const Component& component, const Matrix3* turns,
                                   std::vector<double>& values) const {
  const auto into = [&](double weight, double constraint, const Matrix3* turned) {
    return LocalMatrix(placement.places, values.data(), weight, constraint, turned);
  };
  LocalTangent tangent{
      into(weights.stiffness, weights.constraint, turns),
      into(weights.damping, weights.damping, nullptr),
      into(weights.mass, weights.mass, nullptr),
      placement.stiffness && (weights.stiffness != 0 || (weights.constraint != 0 && local.slots().multipliers > 0)),
      placement.damping && weights.damping != 0,
      placement.mass && weights.mass != 0};
  if (tangent.wants_K || tangent.wants_C || tangent.wants_M) component.add_tangent(local, tangent);
}

namespace {

TangentWorkspace& workspace(int rows) {
  thread_local std::unique_ptr<TangentWorkspace> work;
  if (!work || work->r.size() < rows) work = std::make_unique<TangentWorkspace>(rows);
  return *work;
}

}  // namespace

bool TangentAssembly::set_values(const State& state, const Environment& environment, const TangentWeights& weights,
                                 const VectorX* dq, std::vector<double>& values) {
  const bool again = set_values_of_members(state, environment, weights, dq, values);
  add_held(state, environment, weights, values);
  return again;
}

/// Adds the derivatives of the equations of first-order unknowns that released members keep. The residuals of algebraic
/// unknowns and of statics are zero: any slope along the unknown itself makes its increment zero.
void TangentAssembly::add_held(const State& state, const Environment& environment, const TangentWeights& weights,
                               std::vector<double>& values) const {
  if (held_when_released_.empty()) return;
  for (std::size_t m = 0; m < placements_.size(); ++m) {
    if (!unknowns_.activities().is_governed(m) || unknowns_.is_active(state, m)) continue;
    const Slots& slots = unknowns_.slots()[m];
    const int begin = unknowns_.first_first_order() + slots.first_order_begin;
    for (int i = begin; i < begin + slots.first_orders; ++i) {
      const std::vector<int>& algebraic = unknowns_.algebraic();
      const bool has_no_rate = environment.statics || std::binary_search(algebraic.begin(), algebraic.end(),
                                                                         i - unknowns_.first_first_order());
      values[static_cast<std::size_t>(pattern_->whole.find(i, i))] +=
          has_no_rate ? weights.stiffness : weights.first_order;
    }
  }
}

bool TangentAssembly::set_values_of_members(const State& state, const Environment& environment,
                                            const TangentWeights& weights, const VectorX* dq,
                                            std::vector<double>& values) {
  if (add_values(state, environment, weights, dq, values)) return false;
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    pairs_[k].choose(LocalState(state, unknowns_.slots()[pairs_member_[k]], environment));
  build_pattern();
  if (!add_values(state, environment, weights, dq, values))
    throw std::logic_error("a component acts between two nodes that are no near pair of its own");
  return true;
}

/// @returns false if a pair acts whose entries are not in the pattern
bool TangentAssembly::add_values(const State& state, const Environment& environment, const TangentWeights& weights,
                                 const VectorX* dq, std::vector<double>& values) const {
  thread_local std::vector<Matrix3> step_tangent;
  thread_local std::vector<double> waiting_entries;
  values.assign(static_cast<std::size_t>(pattern_->whole.entry_count()), 0.0);
  if (dq) {
    step_tangent.resize(state.nodes.size());
    for (const auto [node, begin] : kinematics_.all_free())
      step_tangent[node] = mechanism::tangent(dq->segment<3>(begin + 3));
  }
  const TangentRequest request{kinematics_, weights, dq, dq ? step_tangent.data() : nullptr};
  waiting_entries.assign(waiting_.back(), 0.0);
  std::vector<double>& waiting = waiting_entries;  // all threads use the buffer of the calling thread
  const auto evaluate_costly = [&](std::size_t k) {
    const std::size_t m = work_.costly()[k];
    if (!unknowns_.is_active(state, m)) return;
    const LocalState local(state, unknowns_.slots()[m], environment);
    TangentWorkspace& work = workspace(largest_local_);
    if (weights.velocity_level && local.slots().multipliers > 0) work.probe = state;
    MemberTangent member(request, placements_[m], local, *model_.members()[m].component, work);
    const double* entries = placements_[m].contributes() ? member.reduced() : nullptr;
    if (!entries) return;
    placements_[m].lone.scatter(entries, values);
    placements_[m].targets.collect(entries, waiting.data() + waiting_[k]);
  };
  bool complete = true;
  work_.share(evaluate_costly, [&] { complete = add_small(state, environment, request, values); });
  for (std::size_t k = 0; k < work_.costly().size(); ++k)
    placements_[work_.costly()[k]].targets.scatter_collected(waiting.data() + waiting_[k], values);
  return complete;
}

/// Adds the entries of all members that are not costly. @returns false if a pair acts whose entries are not in the
/// pattern
bool TangentAssembly::add_small(const State& state, const Environment& environment, const TangentRequest& request,
                                std::vector<double>& values) const {
  TangentWorkspace& work = workspace(largest_local_);
  if (request.weights.velocity_level) work.probe = state;
  bool complete = true;
  for (const std::size_t m : small_) {
    if (!unknowns_.is_active(state, m)) continue;
    const LocalToGlobal& placement = placements_[m];
    const LocalState local(state, unknowns_.slots()[m], environment);
    if (const PairTangents* pairs = pairs_of(m)) {
      if (!request.weights.velocity_level) complete = pairs->add(local, request, values) && complete;
      continue;
    }
    const Component& component = *model_.members()[m].component;
    if (placement.in_place && !request.weights.velocity_level)
      add_in_place(placement, local, request.weights, component, request.turns, values);
    else
      MemberTangent(request, placement, local, component, work).add_to(values);
  }
  return complete;
}

}  // namespace bielle::mechanism
