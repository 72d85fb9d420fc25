#include "mechanism/solvers/start/massless_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"

namespace bielle::mechanism {
namespace {

/// Returns sums of |entries| of each column's dofs, for a part of the tangent.
VectorX column_sums(const System& system, const State& state, const Environment& environment,
                    const TangentWeights& weights) {
  std::vector<double> values;
  system.tangent(state, environment, weights, nullptr, values);
  const SparsePattern& pattern = system.pattern();
  VectorX sums = VectorX::Zero(system.dofs());
  for (int column = 0; column < system.dofs(); ++column)
    for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
         k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k)
      if (pattern.row()[static_cast<std::size_t>(k)] < system.dofs())
        sums[column] += std::abs(values[static_cast<std::size_t>(k)]);
  return sums;
}

/// Returns, for each amplitude, the force that is due to a displacement by its scale, as a reference for its forces. It
/// is zero for all other unknowns.
VectorX own_forces(const System& system, const State& state, const Environment& environment) {
  std::vector<double> values;
  system.tangent(state, environment, TangentWeights{1, 0, 0, 0, 0}, nullptr, values);
  VectorX forces = VectorX::Zero(system.dofs());
  for (int i = 0; i < system.dofs(); ++i)
    if (const int place = system.pattern().find(i, i); place >= 0)
      forces[i] = std::abs(values[static_cast<std::size_t>(place)]) * system.scale(i);
  return forces;
}

class Balance {
 public:
  Balance(const System& system, const Environment& environment, const State& state)
      : system_(system),
        environment_(environment),
        linear_(system),
        mass_(column_sums(system, state, environment, TangentWeights{0, 0, 1, 0, 0})),
        damping_(column_sums(system, state, environment, TangentWeights{0, 1, 0, 0, 0})),
        own_forces_(own_forces(system, state, environment)),
        r_(system.size()),
        step_(system.size()) {
    length_ = model_length(state);
  }

  bool needed() const { return (mass_.array() == 0).any(); }

  /// Returns the worst unknown if no balance is found, -1 if it is found.
  int find(State& state) {
    constexpr int most = 50;
    measure(state);
    for (int iteration = 0; iteration < most && worst_ >= 0; ++iteration) {
      const double before = size_;
      const State base = state;
      for (double part = 1; part > 0.05; part /= 2) {
        state = base;
        if (!improve(state, part)) return worst_;
        measure(state);
        if (size_ < before) break;
      }
      if (!(size_ < before)) return worst_;
    }
    return worst_;
  }

  /// Computes velocities that maintain the balance of undamped directions and satisfy the non-holonomic constraints.
  void follow(State& state) {
    VectorX v(system_.dofs()), a(system_.dofs());
    system_.get_rates(state, v, a);
    for (int i = 0; i < v.size(); ++i)
      if (massless(i) && !damped(i)) v[i] = 0;
    double rate = 0;
    for (int i = 0; i < v.size(); ++i)
      rate = std::max(rate, std::abs(v[i]) / (system_.kind(i) == Kind::translation ? length_ : 1.0));
    const double e = 1e-6 / std::max(rate, 1.0);  // [s]
    State ahead = state;
    ahead.time = state.time + e;
    system_.displace(ahead, state, e * v);
    system_.set_rates(ahead, v, a);
    measure(ahead);
    for (int i = 0; i < system_.dofs(); ++i)
      if (damped(i)) r_[i] = 0;
    add_prescribed_rates(ahead, e);
    if (!solve_positions(ahead)) return;
    for (int i = 0; i < v.size(); ++i)
      if (massless(i) && !damped(i)) v[i] = step_[i] / e;
    system_.set_rates(state, v, a);
  }

 private:
  bool massless(int i) const { return mass_[i] == 0; }
  bool damped(int i) const { return massless(i) && damping_[i] > 0; }

  /// Computes forces on directions without mass, with the corresponding accelerations and multipliers; the other rows
  /// are zero.
  void measure(State& state) {
    make_accelerations_consistent(system_, environment_, state);
    ResidualScale now;
    system_.residual(state, environment_, r_, &now);
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      scale_.largest[kind] = std::max(scale_.largest[kind], now.largest[kind]);
    constexpr double balanced = 1e-10;  // relative to the largest forces during the search
    size_ = 0;
    worst_ = -1;
    for (int i = 0; i < system_.dofs(); ++i) {
      if (!massless(i)) {
        r_[i] = 0;
        continue;
      }
      double whole = own_forces_[i] > 0 ? own_forces_[i] : scale_[system_.kind(i)];
      // An amplitude that is only moved by constraints (a place on a curve) has only the rounding errors of their
      // forces.
      if (own_forces_[i] == 0 && system_.kind(i) == Kind::amplitude) whole = std::max(whole, scale_[Kind::translation]);
      const double size = std::abs(r_[i]) / (balanced * whole);
      if (!(size > 1) || size <= size_) continue;
      size_ = size;
      worst_ = i;
    }
    r_.segment(system_.dofs(), system_.first_orders()).setZero();
    for (int k = 0; k < system_.multipliers(); ++k)
      if (system_.constraint_kind(k) != ConstraintKind::holonomic) r_[r_.size() - system_.multipliers() + k] = 0;
  }

  /// Adds the rows of non-holonomic constraints, B v + c = 0, over a short time: they determine velocities, not
  /// positions.
  void add_prescribed_rates(const State& ahead, double duration) {
    VectorX rate(system_.multipliers()), unused(system_.multipliers());
    system_.constraint_rates(ahead, environment_, rate, unused);
    system_.for_each_idle(ahead, [&](int k) { rate[k] = 0; });
    for (int k = 0; k < system_.multipliers(); ++k)
      if (system_.constraint_kind(k) == ConstraintKind::nonholonomic)
        r_[r_.size() - system_.multipliers() + k] = duration * rate[k];
  }

  /// In both solutions, dofs with mass are held only by the mass, as in a step of zero duration.
  bool solve_positions(const State& state) { return solve(state, 1, 0, true); }
  bool solve_velocities(const State& state) { return solve(state, 0, 1, false); }
  bool solve(const State& state, double stiffness, double damping, bool holds_damped) {
    constexpr double stiff = 1e13;
    TangentWeights weights{stiffness, damping, 0, 1, 1, true};
    linear_.assemble(state, environment_, weights, nullptr);
    double most = 0, mass = 0;
    for (int i = 0; i < system_.dofs(); ++i) {
      most = std::max(most, std::abs(linear_.diagonal(i)));
      mass = std::max(mass, mass_[i]);
    }
    if (most == 0) return false;
    weights.mass = mass > 0 ? stiff * most / mass : 0;
    VectorX held = VectorX::Zero(system_.dofs());
    for (int i = 0; i < system_.dofs(); ++i)
      if (massless(i) && damped(i) == holds_damped) held[i] = stiff * most;
    if (!linear_.try_factor(state, environment_, weights, nullptr, &held)) return false;
    linear_.solve(r_, step_);
    return step_.allFinite();
  }

  /// Makes a fraction of an iteration of Newton's method: for positions of undamped directions, and velocities of
  /// others.
  bool improve(State& state, double part) {
    constexpr double longest = 0.3;  // relative to the mechanism's size, or [rad]
    const VectorX r = r_;
    const State base = state;
    VectorX v(system_.dofs()), a(system_.dofs());
    system_.get_rates(state, v, a);
    if ((damping_.array() > 0 && mass_.array() == 0).any()) {
      r_.tail(system_.multipliers()).setZero();
      if (!solve_velocities(base)) return false;
      for (int i = 0; i < v.size(); ++i)
        if (damped(i)) v[i] += part * step_[i];
    }
    if ((damping_.array() == 0 && mass_.array() == 0).any()) {
      r_ = r;
      if (!solve_positions(base)) return false;
      double extent = 0;
      for (int i = 0; i < v.size(); ++i)
        extent = std::max(extent, std::abs(step_[i]) / (system_.kind(i) == Kind::translation ? length_ : 1.0));
      const double shorter = std::min(1.0, longest / std::max(extent, 1e-300));
      system_.displace(state, base, part * shorter * step_.head(system_.dofs()));
    }
    system_.set_rates(state, v, a);
    r_ = r;
    return true;
  }

  const System& system_;
  const Environment& environment_;
  NewtonMatrix linear_;
  VectorX mass_, damping_, own_forces_;
  double length_ = 1;
  VectorX r_, step_;
  ResidualScale scale_;
  double size_ = 0;
  int worst_ = -1;
};

}  // namespace

void balance_massless(const System& system, const Environment& environment, State& state, StartReport& report) {
  Balance balance(system, environment, state);
  if (!balance.needed()) return;
  const State given = state;
  if (const int worst = balance.find(state); worst >= 0) {
    state = given;
    report.unbalanced = system.unknown_name(worst);
    make_accelerations_consistent(system, environment, state);
    return;
  }
  balance.follow(state);
  make_accelerations_consistent(system, environment, state);
  note_farthest(system, given, state, report.balanced, report.balanced_node);
}

}  // namespace bielle::mechanism
