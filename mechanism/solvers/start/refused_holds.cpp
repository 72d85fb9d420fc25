#include "mechanism/solvers/start/refused_holds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"

namespace bielle::mechanism {
namespace {

char& idle_of(State& state, int multiplier) { return state.idle[static_cast<std::size_t>(multiplier)]; }

/// Returns the overload of a hold at a state, as its component computes it; not positive if it holds.
double overload(const System& system, const VectorX& values, int hold) {
  double most = 0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const MemberEventFunction& each = system.event_functions()[static_cast<std::size_t>(k)];
    const Slots& slots = system.slots()[each.member];
    const int own = hold - slots.multiplier_begin;
    if (each.function.one_by_one && own >= 0 && own < slots.multipliers) most = std::max(most, -values[k]);
  }
  return most;
}

}  // namespace

std::vector<int> active_holds(const System& system, const State& state) {
  std::vector<int> holds;
  for (int k = 0; k < static_cast<int>(state.idle.size()); ++k)
    if (system.yields(k) && state.idle[static_cast<std::size_t>(k)] == Idle::active) holds.push_back(k);
  return holds;
}

bool holds_stop_more(const System& system, const Environment& environment, const State& state,
                     const std::vector<int>& new_holds, KktMatrix& saddle) {
  if (new_holds.empty()) return false;
  State held = state, free = state;
  for (const int hold : new_holds) idle_of(free, hold) = Idle::redundant;
  StartReport unused;
  for (State* each : {&free, &held}) {
    saddle.serve_no_more();
    make_velocities_consistent(system, environment, *each, unused, saddle);
  }
  saddle.serve_no_more();
  VectorX with(system.dofs()), without(system.dofs()), a(system.dofs());
  system.get_rates(held, with, a);
  system.get_rates(free, without, a);
  std::array<double, kind_count> change{}, size{};
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    change[kind] = std::max(change[kind], std::abs(with[i] - without[i]));
    size[kind] = std::max(size[kind], std::abs(without[i]));
  }
  // The limit is far above the residual rate at a located zero, and far below the motion stopped at a dead centre.
  constexpr double nothing = 1e-6;
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (change[kind] > nothing * size[kind]) return true;
  return false;
}

void refuse_holds(const System& system, const Environment& environment, State& state, std::vector<int> new_holds,
                  Overloaded overloaded, KktMatrix& saddle) {
  VectorX values = VectorX::Zero(static_cast<Eigen::Index>(system.event_functions().size()));
  while (!new_holds.empty()) {
    State trial = state;
    for (const int hold : new_holds) idle_of(trial, hold) = Idle::redundant;
    saddle.serve_no_more();
    StartReport unused;
    make_velocities_consistent(system, environment, trial, unused, saddle);
    for (const int hold : new_holds) idle_of(trial, hold) = Idle::active;
    saddle.serve_no_more();
    auto refused = new_holds.end();
    try {
      make_accelerations_consistent(system, environment, trial, saddle);
      if (overloaded == Overloaded::refused) system.calc_event_functions(trial, environment, values);
      double most = 0;
      for (auto hold = new_holds.begin(); hold != new_holds.end(); ++hold)
        if (const double each = overload(system, values, *hold); each > most) {
          most = each;
          refused = hold;
        }
    } catch (const ComputationError&) {
      refused = new_holds.end() - 1;
    }
    saddle.serve_no_more();
    if (refused == new_holds.end()) return;
    idle_of(state, *refused) = Idle::redundant;
    state.multiplier[*refused] = 0;
    new_holds.erase(refused);
  }
}

}  // namespace bielle::mechanism
