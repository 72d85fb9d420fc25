#include "mechanism/solvers/start/branch_sign.hpp"

#include <utility>

namespace bielle::mechanism {

void BranchSign::choose_rows(const State& state) {
  if (chosen_ && idle_ == state.idle && of_ == system_.shared_pattern()) return;
  chosen_ = true;
  of_ = system_.shared_pattern();
  idle_ = state.idle;
  factors_.reset();
  pattern_.reset();
  places_.clear();
  known_at_.clear();
  std::vector<bool> idle(static_cast<std::size_t>(system_.multipliers()), false);
  system_.for_each_idle(state, [&](int k) { idle[static_cast<std::size_t>(k)] = true; });
  std::vector<int> row(idle.size(), -1);
  int rows = 0;
  for (std::size_t k = 0; k < idle.size(); ++k)
    if (!idle[k]) row[k] = rows++;
  if (rows != system_.dofs() || rows == 0) return;
  const int first = system_.size() - system_.multipliers();
  std::vector<std::pair<int, int>> entries;
  system_.pattern().for_each([&](int place, int of, int column) {
    if (of < first || column >= rows || row[static_cast<std::size_t>(of - first)] < 0) return;
    entries.emplace_back(row[static_cast<std::size_t>(of - first)], column);
    places_.push_back(place);
  });
  // Both patterns are ordered by columns with ascending rows, so that the places are in the order of the new pattern.
  pattern_ = std::make_unique<SparsePattern>(rows, std::move(entries));
  factors_ = std::make_unique<SparseLU>(*pattern_);
}

int BranchSign::sign_at(const Environment& environment, const State& state) {
  if (is_known(state)) return known_sign_;
  known_time_ = state.time;
  known_at_.clear();
  for (const NodeState& node : state.nodes) known_at_.push_back(node.x);
  known_sign_ = 0;
  system_.tangent(state, environment, TangentWeights{0, 0, 0, 0, 1, true}, nullptr, tangent_);
  values_.clear();
  for (const int place : places_) values_.push_back(tangent_[static_cast<std::size_t>(place)]);
  if (factors_->factor(values_, VectorX::Ones(pattern_->size())) == FactorStatus::good)
    known_sign_ = factors_->determinant_sign();
  return known_sign_;
}

/// Returns whether the sign is known at the state. This is frequent, because the end of a step is usually the beginning
/// of the next one.
bool BranchSign::is_known(const State& state) const {
  if (state.time != known_time_ || known_at_.size() != state.nodes.size()) return false;
  for (std::size_t i = 0; i < known_at_.size(); ++i)
    if (known_at_[i] != state.nodes[i].x) return false;
  return true;
}

bool BranchSign::same(const Environment& environment, const State& one, const State& other) {
  if (one.idle != other.idle) return true;
  choose_rows(one);
  if (!factors_) return true;
  const int before = sign_at(environment, one), after = sign_at(environment, other);
  return before == 0 || after == 0 || before == after;
}

}  // namespace bielle::mechanism
