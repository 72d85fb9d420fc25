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

SparsePattern large_pattern(const System& system, const std::vector<bool>& holonomic) {
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

StabilisedEquations::StabilisedEquations(const System& system)
    : StepEquations(system),
      holonomic_(find_holonomic(system)),
      active_(holonomic_),
      pattern_(large_pattern(system, holonomic_)),
      places_(static_cast<std::size_t>(system.pattern().entry_count())),
      condensed_(pattern_, with_corrections(system)),
      factors_(condensed_) {
  const int n = system.dofs(), first = system.size() - system.multipliers(), eta = system.size(), mu = eta + n;
  system.pattern().for_each([&](int k, int row, int column) {
    Places& places = places_[static_cast<std::size_t>(k)];
    places.tangent = pattern_.find(row, column);
    if (column >= n) return;
    places.position = pattern_.find(row, eta + column);
    if (row < first || !holonomic_[static_cast<std::size_t>(row - first)]) return;
    places.velocity = pattern_.find(mu + row - first, column);
    places.velocity_position = pattern_.find(mu + row - first, eta + column);
    places.constraint = pattern_.find(eta + column, mu + row - first);
  });
  std::vector<int> intermittent;
  for (const int k : system.pattern().intermittent()) {
    const Places& places = places_[static_cast<std::size_t>(k)];
    for (const int place : {places.tangent, places.position})
      if (place >= 0) intermittent.push_back(place);
  }
  std::sort(intermittent.begin(), intermittent.end());
  pattern_.set_intermittent(std::move(intermittent));
  for (int i = 0; i < n; ++i) weight_places_.push_back(pattern_.find(eta + i, eta + i));
  for (int k = 0; k < system.multipliers(); ++k) idle_places_.push_back(pattern_.find(mu + k, mu + k));
  values_.resize(static_cast<std::size_t>(pattern_.entry_count()));
  scale_.setOnes(size());
}

void StabilisedEquations::begin(const State& state, const Environment& environment) {
  const int n = system_.dofs();
  eta_.setZero(n);
  mu_.setZero(system_.multipliers());
  active_ = holonomic_;
  system_.for_each_idle(state, [&](int k) { active_[static_cast<std::size_t>(k)] = false; });
  system_.tangent(state, environment, TangentWeights{0, 0, 1, 0, 1}, nullptr, constraint_);
  // Any positive weights are possible; with masses, positions move as by an impulse.
  constexpr double floor = 1e-6;
  weight_.setZero(n);
  std::array<double, kind_count> largest{};
  for (int i = 0; i < n; ++i) {
    if (const int place = system_.pattern().find(i, i); place >= 0)
      weight_[i] = std::abs(constraint_[static_cast<std::size_t>(place)]);
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
  const int n = system_.dofs(), m = system_.multipliers(), first = system_.size() - m;
  system_.residual(trial, environment, r.head(system_.size()), &scale);
  auto balance = r.segment(system_.size(), n);
  balance = weight_.cwiseProduct(eta_);
  system_.pattern().for_each([&](int k, int row, int column) {
    if (places_[static_cast<std::size_t>(k)].constraint >= 0)
      balance[column] -= constraint_[static_cast<std::size_t>(k)] * mu_[row - first];
  });
  VectorX rate(m), unused(m);
  system_.constraint_rates(trial, environment, rate, unused);
  for (int k = 0; k < m; ++k) r[system_.size() + n + k] = holds(k) ? rate[k] : mu_[k];
}

void StabilisedEquations::factor(const SchemeStep& step, const Environment& environment) {
  const State& trial = step.trial();
  const VectorX* dq = &step.dq();
  linear_.assemble(trial, environment, step.weights(), dq);
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
  if (factors_.factor(values_, scale_, system_.workers()) != FactorStatus::good) linear_.throw_singular(trial.time);
}

void StabilisedEquations::put_values() {
  std::fill(values_.begin(), values_.end(), 0.0);
  const auto put = [&](int place, double value) {
    if (place >= 0) values_[static_cast<std::size_t>(place)] = value;
  };
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Places& places = places_[k];
    put(places.tangent, linear_.values()[k]);
    put(places.position, position_[k]);
    put(places.velocity, velocity_[k]);
    put(places.velocity_position, velocity_position_[k]);
    put(places.constraint, -constraint_[k]);
  }
  for (int i = 0; i < system_.dofs(); ++i) put(weight_places_[static_cast<std::size_t>(i)], weight_[i]);
  for (int k = 0; k < system_.multipliers(); ++k)
    if (!holds(k)) put(idle_places_[static_cast<std::size_t>(k)], 1);
}

void StabilisedEquations::solve(const VectorX& r, VectorX& delta) const {
  delta = -r;
  factors_.solve(delta);
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
  constexpr int tangents = 4;  // those of `factor`
  return count_costs(system_, size(), tangents, factors_.cost());
}

void StabilisedEquations::choose_pivots_anew() {
  StepEquations::choose_pivots_anew();
  factors_.forget();
}

}  // namespace bielle::mechanism
