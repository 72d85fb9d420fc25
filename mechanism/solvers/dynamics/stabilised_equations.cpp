#include "mechanism/solvers/dynamics/stabilised_equations.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {
namespace {

/// Finds the constraints that may also be satisfied on the velocity level: holonomic ones that are not permanently
/// removed.
std::vector<bool> find_holonomic(const System& system) {
  std::vector<bool> holonomic(static_cast<std::size_t>(system.multipliers()));
  for (int k = 0; k < system.multipliers(); ++k)
    holonomic[static_cast<std::size_t>(k)] = system.constraint_kind(k) == ConstraintKind::holonomic;
  for (const int k : system.set_aside()) holonomic[static_cast<std::size_t>(k)] = false;
  return holonomic;
}

/// Finds amplitudes that may be condensed, each with its eta.
std::vector<std::vector<int>> with_corrections(const System& system) {
  std::vector<std::vector<int>> blocks = system.lone_amplitudes();
  for (std::vector<int>& block : blocks) {
    const std::size_t count = block.size();
    for (std::size_t k = 0; k < count; ++k) block.push_back(system.size() + block[k]);
  }
  return blocks;
}

}  // namespace

/// The large matrix: its pattern, which follows that of the system's tangent, and its factors.
struct StabilisedEquations::LargeMatrix {
  /// An entry of the system's pattern with its places in the large one, -1 if it has none.
  struct Places {
    int tangent = -1;                           ///< place in J
    int position = -1;                          ///< place in J_q
    int velocity = -1, velocity_position = -1;  ///< constraint rows: places in J_v and N T
  };
  LargeMatrix(const System& system, const std::vector<bool>& holonomic,
              const std::vector<std::pair<int, int>>& constraint_entries)
      : of(system.shared_pattern()),
        pattern(make_pattern(system, holonomic)),
        places(static_cast<std::size_t>(of->whole.entry_count())),
        condensed(find_places(system, holonomic), with_corrections(system)),
        factors(condensed) {
    const int n = system.dofs(), eta = system.size(), mu = eta + n;
    for (const auto& [multiplier, dof] : constraint_entries)
      constraint_places.push_back(pattern.find(eta + dof, mu + multiplier));
    for (int i = 0; i < n; ++i) weight_places.push_back(pattern.find(eta + i, eta + i));
    for (int k = 0; k < system.multipliers(); ++k) idle_places.push_back(pattern.find(mu + k, mu + k));
  }

  static SparsePattern make_pattern(const System& system, const std::vector<bool>& holonomic) {
    const int n = system.dofs(), first = system.size() - system.multipliers(), eta = system.size(), mu = eta + n;
    std::vector<std::pair<int, int>> entries;
    system.pattern().for_each([&](int, int row, int column) {
      entries.emplace_back(row, column);
      if (column >= n) return;
      entries.emplace_back(row, eta + column);
      if (row < first || !holonomic[static_cast<std::size_t>(row - first)]) return;
      const int rate_row = mu + row - first;
      entries.emplace_back(rate_row, column);
      entries.emplace_back(rate_row, eta + column);
      entries.emplace_back(eta + column, rate_row);
    });
    for (int i = eta; i < mu + system.multipliers(); ++i) entries.emplace_back(i, i);
    return SparsePattern(mu + system.multipliers(), std::move(entries));
  }

  /// @returns the pattern, with its intermittent entries
  const SparsePattern& find_places(const System& system, const std::vector<bool>& holonomic) {
    const int n = system.dofs(), first = system.size() - system.multipliers(), eta = system.size(), mu = eta + n;
    of->whole.for_each([&](int k, int row, int column) {
      Places& each = places[static_cast<std::size_t>(k)];
      each.tangent = pattern.find(row, column);
      if (column >= n) return;
      each.position = pattern.find(row, eta + column);
      if (row < first || !holonomic[static_cast<std::size_t>(row - first)]) return;
      each.velocity = pattern.find(mu + row - first, column);
      each.velocity_position = pattern.find(mu + row - first, eta + column);
    });
    std::vector<int> intermittent;
    for (const int k : of->whole.intermittent()) {
      const Places& each = places[static_cast<std::size_t>(k)];
      for (const int place : {each.tangent, each.position})
        if (place >= 0) intermittent.push_back(place);
    }
    std::sort(intermittent.begin(), intermittent.end());
    pattern.set_intermittent(std::move(intermittent));
    return pattern;
  }

  std::shared_ptr<const TangentPattern> of;  ///< the system's pattern
  SparsePattern pattern;
  std::vector<Places> places;                   ///< for each entry of the system's pattern
  std::vector<int> constraint_places;           ///< places in -B_n^T
  std::vector<int> weight_places, idle_places;  ///< diagonals of W, and of mu (used if it has no constraint)
  CondensedPattern condensed;
  CondensedLU factors;
};

StabilisedEquations::StabilisedEquations(const System& system)
    : StepEquations(system), holonomic_(find_holonomic(system)), active_(holonomic_) {
  const int first = system.size() - system.multipliers();
  system.pattern().for_each([&](int, int row, int column) {
    if (row >= first && column < system.dofs() && holonomic_[static_cast<std::size_t>(row - first)])
      constraint_entries_.emplace_back(row - first, column);
  });
  large_ = std::make_unique<LargeMatrix>(system, holonomic_, constraint_entries_);
  scale_.setOnes(size());
}

StabilisedEquations::~StabilisedEquations() = default;

void StabilisedEquations::begin(const State& state, const Environment& environment) {
  const int n = system_.dofs();
  eta_.setZero(n);
  mu_.setZero(system_.multipliers());
  active_ = holonomic_;
  system_.for_each_idle(state, [&](int k) { active_[static_cast<std::size_t>(k)] = false; });
  std::vector<double>& masses = position_;
  system_.tangent(state, environment, TangentWeights{0, 0, 1, 0, 1}, nullptr, masses);
  constraint_.clear();
  for (const auto& [multiplier, dof] : constraint_entries_)
    constraint_.push_back(masses[static_cast<std::size_t>(
        system_.pattern().find(system_.size() - system_.multipliers() + multiplier, dof))]);
  // Any positive weights are possible; with masses, positions move as by an impulse.
  constexpr double floor = 1e-6;
  weight_.setZero(n);
  std::array<double, kind_count> largest{};
  for (int i = 0; i < n; ++i) {
    if (const int place = system_.pattern().find(i, i); place >= 0)
      weight_[i] = std::abs(masses[static_cast<std::size_t>(place)]);
    double& most = largest[static_cast<std::size_t>(system_.kind(i))];
    most = std::max(most, weight_[i]);
  }
  for (int i = 0; i < n; ++i) {
    const double most = largest[static_cast<std::size_t>(system_.kind(i))];
    weight_[i] = most > 0 ? std::max(weight_[i], floor * most) : 1;
  }
}

void StabilisedEquations::calc_residual(const State& trial, const Environment& environment, VectorX& r,
                                        ResidualScale& scale) const {
  const int n = system_.dofs(), m = system_.multipliers();
  system_.residual(trial, environment, r.head(system_.size()), &scale);
  auto balance = r.segment(system_.size(), n);
  balance = weight_.cwiseProduct(eta_);
  for (std::size_t k = 0; k < constraint_.size(); ++k) {
    const auto [multiplier, dof] = constraint_entries_[k];
    balance[dof] -= constraint_[k] * mu_[multiplier];
  }
  VectorX rate(m), unused(m);
  system_.constraint_rates(trial, environment, rate, unused);
  for (int k = 0; k < m; ++k) r[system_.size() + n + k] = holds(k) ? rate[k] : mu_[k];
}

void StabilisedEquations::factor(const SchemeStep& step, const Environment& environment) {
  const State& trial = step.trial();
  const VectorX* dq = &step.dq();
  linear_.assemble(trial, environment, step.weights(), dq);
  if (large_->of != linear_.pattern()) large_ = std::make_unique<LargeMatrix>(system_, holonomic_, constraint_entries_);
  TangentWeights position, velocity, velocity_position;
  velocity.damping = step.weights().damping;
  velocity.velocity_level = velocity_position.velocity_level = true;
  system_.tangent(trial, environment, position, dq, position_);
  system_.tangent(trial, environment, velocity, dq, velocity_);
  system_.tangent(trial, environment, velocity_position, dq, velocity_position_);
  put_values();
  // lambda is scaled by the size of the forces that move the dofs (see NewtonMatrix), mu by that of their weights.
  const double weight = weight_.size() > 0 ? weight_.maxCoeff() : 1;
  scale_.segment(system_.size() - system_.multipliers(), system_.multipliers()).setConstant(linear_.scale());
  scale_.tail(system_.multipliers()).setConstant(weight);
  if (large_->factors.factor(values_, scale_, system_.workers()) != FactorStatus::good)
    linear_.throw_singular(trial.time);
}

void StabilisedEquations::put_values() {
  values_.assign(static_cast<std::size_t>(large_->pattern.entry_count()), 0.0);
  const auto put = [&](int place, double value) {
    if (place >= 0) values_[static_cast<std::size_t>(place)] = value;
  };
  for (std::size_t k = 0; k < large_->places.size(); ++k) {
    const LargeMatrix::Places& places = large_->places[k];
    put(places.tangent, linear_.values()[k]);
    put(places.position, position_[k]);
    put(places.velocity, velocity_[k]);
    put(places.velocity_position, velocity_position_[k]);
  }
  for (std::size_t k = 0; k < constraint_.size(); ++k) put(large_->constraint_places[k], -constraint_[k]);
  for (int i = 0; i < system_.dofs(); ++i) put(large_->weight_places[static_cast<std::size_t>(i)], weight_[i]);
  for (int k = 0; k < system_.multipliers(); ++k)
    if (!holds(k)) put(large_->idle_places[static_cast<std::size_t>(k)], 1);
}

void StabilisedEquations::solve(const VectorX& r, VectorX& delta) const {
  delta = -r;
  large_->factors.solve(delta);
}

void StabilisedEquations::move(SchemeStep& step, const VectorX& delta, double part) {
  step.move(delta, part);
  const VectorX change = part * delta.segment(system_.size(), system_.dofs());
  eta_ += change;
  step.move_positions(change);
  mu_ += part * delta.tail(system_.multipliers());
}

const VectorX& StabilisedEquations::judged(const VectorX& r, double h) {
  const int m = system_.multipliers(), first = system_.size() - m;
  judged_ = r.head(system_.size());
  for (int i = 0; i < m; ++i) {
    const double rate = h * r[r.size() - m + i];
    if (!(std::abs(rate) <= std::abs(judged_[first + i]))) judged_[first + i] = rate;
  }
  return judged_;
}

StepCosts StabilisedEquations::costs() const {
  constexpr int tangents = 4;  // number of tangents that factor() computes
  return count_costs(system_, size(), tangents, large_->factors.cost());
}

void StabilisedEquations::choose_pivots_anew() {
  StepEquations::choose_pivots_anew();
  large_->factors.forget();
}

}  // namespace bielle::mechanism
