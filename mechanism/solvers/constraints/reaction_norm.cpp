#include "mechanism/solvers/constraints/reaction_norm.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/constraints/redundancy.hpp"

namespace bielle::mechanism {
namespace {

constexpr double delta = 1e-7;

/// Maps an unknown to its number in this matrix: dofs, then multipliers. @returns -1 for first-order unknowns
int number(const System& system, int unknown) {
  if (unknown < system.dofs()) return unknown;
  const int multiplier = unknown - system.dofs() - system.first_orders();
  return multiplier < 0 ? -1 : system.dofs() + multiplier;
}

/// Returns whether an entry of the system's pattern belongs to B; B^T is its transpose.
bool is_constraint(const System& system, int row, int column) {
  return row >= system.dofs() + system.first_orders() && column < system.dofs();
}

SparsePattern make_pattern(const System& system) {
  const int n = system.dofs();
  std::vector<std::pair<int, int>> entries;
  system.pattern().for_each([&](int, int row, int column) {
    if (!is_constraint(system, row, column)) return;
    entries.emplace_back(number(system, row), column);
    entries.emplace_back(column, number(system, row));
  });
  for (int i = 0; i < n + system.multipliers(); ++i) entries.emplace_back(i, i);
  for (const Slots& slots : system.slots())
    for (int i = 0; i < slots.multipliers; ++i)
      for (int j = 0; j < slots.multipliers; ++j)
        entries.emplace_back(n + slots.multiplier_begin + i, n + slots.multiplier_begin + j);
  return SparsePattern(n + system.multipliers(), std::move(entries));
}

}  // namespace

ReactionNorm::ReactionNorm(const System& system) : system_(system), pattern_(make_pattern(system)), factors_(pattern_) {
  find_entries();
  const int n = system.dofs();
  for (const Slots& slots : system.slots()) {
    norm_begin_.push_back(static_cast<int>(norm_places_.size()));
    for (int j = 0; j < slots.multipliers; ++j)
      for (int i = 0; i < slots.multipliers; ++i)
        norm_places_.push_back(pattern_.find(n + slots.multiplier_begin + i, n + slots.multiplier_begin + j));
  }
  for (int i = 0; i < n; ++i) diagonal_.push_back(pattern_.find(i, i));
  values_.resize(static_cast<std::size_t>(pattern_.entry_count()));
  scale_.setOnes(pattern_.size());
}

/// Finds the entries of the system's pattern: those of constraints are the same in all its patterns.
void ReactionNorm::find_entries() {
  of_ = system_.shared_pattern();
  from_.assign(2 * static_cast<std::size_t>(of_->whole.entry_count()), -1);
  of_->whole.for_each([&](int k, int row, int column) {
    if (!is_constraint(system_, row, column)) return;
    from_[2 * static_cast<std::size_t>(k)] = pattern_.find(number(system_, row), column);
    from_[2 * static_cast<std::size_t>(k) + 1] = pattern_.find(column, number(system_, row));
  });
}

bool ReactionNorm::needed(const System& system, const State& state) {
  bool any = false;
  system.for_each_redundant(state, [&](int) { any = true; });
  return any;
}

void ReactionNorm::factor(const Environment& environment, const State& state) {
  State whole = with_redundant(system_, state);
  // A constraint that yields to others has no reaction.
  for (int k = 0; k < static_cast<int>(state.idle.size()); ++k)
    if (system_.yields(k)) whole.idle[static_cast<std::size_t>(k)] = state.idle[static_cast<std::size_t>(k)];
  system_.tangent(whole, environment, TangentWeights{0, 0, 0, 0, 1, true}, nullptr, tangent_);
  if (of_ != system_.shared_pattern()) find_entries();
  const double arm = redundancy_arm(system_, environment, whole);
  std::fill(values_.begin(), values_.end(), 0.0);
  of_->whole.for_each([&](int k, int row, int column) {
    if (!is_constraint(system_, row, column)) return;
    for (const std::size_t side : {0U, 1U})
      values_[static_cast<std::size_t>(from_[2 * static_cast<std::size_t>(k) + side])] =
          tangent_[static_cast<std::size_t>(k)];
  });
  diagonal_values_.resize(system_.dofs());
  for (int i = 0; i < system_.dofs(); ++i) {
    diagonal_values_[i] = system_.kind(i) == Kind::rotation ? arm * arm : 1;
    values_[static_cast<std::size_t>(diagonal_[static_cast<std::size_t>(i)])] = diagonal_values_[i];
  }
  const int n = system_.dofs();
  for (std::size_t m = 0; m < system_.slots().size(); ++m) {
    const Slots& slots = system_.slots()[m];
    if (slots.multipliers == 0) continue;
    MatrixX H = MatrixX::Zero(slots.multipliers, slots.multipliers);
    system_.model().members()[m].component->add_reaction_norm(LocalState(whole, slots, environment), arm, H);
    // Multipliers that cause no wrench are kept small as well. The term is relative, because forces differ in unit from
    // moments divided by arms.
    for (int k = 0; k < slots.multipliers; ++k) H(k, k) = H(k, k) > 0 ? (1 + 1e-9) * H(k, k) : 1;
    for (int k = 0; k < H.size(); ++k)
      values_[static_cast<std::size_t>(norm_places_[static_cast<std::size_t>(norm_begin_[m] + k)])] =
          -delta * H.data()[k];
    // A constraint that is off has no row in B: its multiplier becomes zero.
  }
  // Multipliers of moments are larger than those of forces by a factor of an arm.
  for (int k = 0; k < system_.multipliers(); ++k) {
    double largest = 0;
    const int column = n + k;
    for (int e = pattern_.column_start()[static_cast<std::size_t>(column)];
         e < pattern_.column_start()[static_cast<std::size_t>(column) + 1]; ++e)
      if (const int row = pattern_.row()[static_cast<std::size_t>(e)]; row < n)
        largest = std::max(largest, std::abs(values_[static_cast<std::size_t>(e)]) / std::sqrt(diagonal_values_[row]));
    scale_[column] = largest > 0 ? 1 / largest : 1;
  }
  for (int i = 0; i < n; ++i) scale_[i] = 1 / std::sqrt(diagonal_values_[i]);
  if (factors_.factor(values_, scale_) != FactorStatus::good)
    throw ComputationError("the reactions of smallest norm could not be found");
}

/// Method of multipliers: D w + B^T lambda = f, B (u + w) = delta H lambda, u <- u + w until w vanishes.
VectorX ReactionNorm::smallest(const VectorX& multiplier) const {
  const int n = system_.dofs(), m = system_.multipliers();
  VectorX f = VectorX::Zero(n), Bu(m), u = VectorX::Zero(n), solution(n + m);
  const auto for_each_constraint = [&](const auto& act) {
    of_->whole.for_each([&](int k, int row, int column) {
      if (is_constraint(system_, row, column))
        act(number(system_, row) - n, column, tangent_[static_cast<std::size_t>(k)]);
    });
  };
  for_each_constraint([&](int row, int column, double value) { f[column] += value * multiplier[row]; });
  constexpr int iterations = 3;
  for (int k = 0; k < iterations; ++k) {
    Bu.setZero();
    for_each_constraint([&](int row, int column, double value) { Bu[row] += value * u[column]; });
    solution << f, -Bu;
    factors_.solve(solution);
    u += solution.head(n);
  }
  return solution.tail(m);
}

void ReactionNorm::balance(const Environment& environment, State& state) {
  state.reaction.resize(0);
  if (!needed(system_, state)) return;
  factor(environment, state);
  state.reaction = smallest(state.multiplier);
}

/// Returns whether event functions read reactions that are not set yet. They are set if forces read them as well,
/// because the equations of the state were then solved with them.
bool EventFunctionValues::needs(const State& state) const {
  if (!system_.event_functions_read_reactions() || !ReactionNorm::needed(system_, state)) return false;
  return !system_.reads_reactions() || state.reaction.size() == 0;
}

bool EventFunctionValues::balance(const Environment& environment, State& state) {
  if (!needs(state)) return false;
  if (!norm_) norm_ = std::make_unique<ReactionNorm>(system_);
  norm_->balance(environment, state);
  return true;
}

void EventFunctionValues::calc(const State& state, const Environment& environment, Eigen::Ref<VectorX> values) {
  if (!needs(state)) {
    system_.calc_event_functions(state, environment, values);
    return;
  }
  State balanced = state;
  balance(environment, balanced);
  system_.calc_event_functions(balanced, environment, values);
}

double EventFunctionValues::calc(const State& state, const Environment& environment, int event_function) {
  if (!needs(state)) return system_.calc_event_function(state, environment, event_function);
  State balanced = state;
  balance(environment, balanced);
  return system_.calc_event_function(balanced, environment, event_function);
}

void ReadReactions::balance(const Environment& environment, State& state) {
  if (!system_.reads_reactions() || !ReactionNorm::needed(system_, state)) {
    state.reaction.resize(0);
    return;
  }
  if (!norm_) norm_ = std::make_unique<ReactionNorm>(system_);
  norm_->balance(environment, state);
}

std::vector<int> ReactionNorm::not_unique(const Environment& environment, const State& state) {
  if (!needed(system_, state)) return {};
  factor(environment, state);
  // The part that the projection removes from arbitrary multipliers causes no forces.
  VectorX any(system_.multipliers());
  for (int k = 0; k < system_.multipliers(); ++k) any[k] = scale_[system_.dofs() + k] * std::cos(1 + 2.4 * k);
  const VectorX free = any - smallest(any);
  std::vector<int> result;
  constexpr double rounding = 1e-6;
  for (int k = 0; k < system_.multipliers(); ++k)
    if (std::abs(free[k]) > rounding * scale_[system_.dofs() + k]) result.push_back(k);
  return result;
}

}  // namespace bielle::mechanism
