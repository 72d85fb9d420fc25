#include "mechanism/system/idle_constraints.hpp"

#include <algorithm>
#include <numeric>

namespace bielle::mechanism {

void IdleConstraints::add(const Declaration& declaration) {
  const std::size_t member = unknowns_.slots().size() - 1;
  const int begin = unknowns_.slots()[member].multiplier_begin;
  const bool governed = unknowns_.activities().is_governed(member);
  for (int k = 0; k < static_cast<int>(declaration.multipliers.size()); ++k) {
    const bool by_itself = declaration.multipliers[static_cast<std::size_t>(k)].switched;
    if (by_itself || governed) switched_.push_back({member, k, begin + k, by_itself});
  }
}

std::vector<bool> IdleConstraints::possible() const {
  std::vector<bool> result(static_cast<std::size_t>(unknowns_.multipliers()), switches());
  for (const int multiplier : set_aside_) result[static_cast<std::size_t>(multiplier)] = true;
  return result;
}

void IdleConstraints::switch_constraints(State& state, const Environment& environment) const {
  if (!switches()) return;
  state.idle.assign(static_cast<std::size_t>(unknowns_.multipliers()), Idle::active);
  for (const Switched& each : switched_) {
    const LocalState local(state, unknowns_.slots()[each.member], environment);
    const bool on = !each.by_itself || model_.members()[each.member].component->is_on(local, each.row);
    if (on && unknowns_.is_active(state, each.member)) continue;
    state.idle[static_cast<std::size_t>(each.multiplier)] = Idle::switched_off;
    state.multiplier[each.multiplier] = 0;
  }
}

void IdleConstraints::find_places(const SparsePattern& pattern) {
  row_begin_.clear();
  row_places_.clear();
  diagonal_.clear();
  column_begin_.clear();
  if (!switches() && set_aside_.empty()) return;
  const std::vector<bool> possible = this->possible();
  const int first = unknowns_.first_multiplier();
  const auto is_possible = [&](int row) { return row >= first && possible[static_cast<std::size_t>(row - first)]; };
  // The places are counted first, then sorted into their rows.
  row_begin_.assign(possible.size() + 1, 0);
  for (const int row : pattern.row())
    if (is_possible(row)) ++row_begin_[static_cast<std::size_t>(row - first) + 1];
  std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
  row_places_.resize(static_cast<std::size_t>(row_begin_.back()));
  diagonal_.assign(possible.size(), -1);
  std::vector<int> next(row_begin_.begin(), row_begin_.end() - 1);
  pattern.for_each([&](int place, int row, int column) {
    if (!is_possible(row)) return;
    const auto k = static_cast<std::size_t>(row - first);
    row_places_[static_cast<std::size_t>(next[k]++)] = place;
    if (row == column) diagonal_[k] = place;
  });
  column_begin_.assign(pattern.column_start().begin() + first, pattern.column_start().end());
}

void IdleConstraints::clear(const State& state, std::vector<double>& values) const {
  for_each(state, [&](int multiplier) {
    const auto k = static_cast<std::size_t>(multiplier);
    for (int each = row_begin_[k]; each < row_begin_[k + 1]; ++each)
      values[static_cast<std::size_t>(row_places_[static_cast<std::size_t>(each)])] = 0;
    std::fill(values.begin() + column_begin_[k], values.begin() + column_begin_[k + 1], 0.0);
    values[static_cast<std::size_t>(diagonal_[k])] = 1;
  });
}

}  // namespace bielle::mechanism
