// Copy of the numbers of a local state that an evaluation of a superelement reads. Residual, tangent, energies and
// records of an accepted step refer to the same state, or to states with the same positions: one evaluation serves all
// of them.
#pragma once

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class KnownState {
 public:
  /// First group of numbers in which a state differs from the previous one.
  enum class Change { positions, velocities, others, none };

  /// Compares a state with the previous one, number by number, and stores it.
  Change next(const LocalState& state) {
    collect_unknowns(state);
    const Change change = compare();
    kept_.swap(now_);
    now_.resize(kept_.size());  // the second state allocates nothing
    return change;
  }

 private:
  Change compare() const {
    if (kept_.size() != now_.size()) return Change::positions;
    const Eigen::Index rates = velocities_ + velocity_count_;
    if (kept_.head(velocities_) != now_.head(velocities_)) return Change::positions;
    if (kept_.segment(velocities_, velocity_count_) != now_.segment(velocities_, velocity_count_))
      return Change::velocities;
    return kept_.tail(kept_.size() - rates) != now_.tail(now_.size() - rates) ? Change::others : Change::none;
  }

  void collect_unknowns(const LocalState& state) {
    const auto nodes = static_cast<Eigen::Index>(state.slots().nodes.size());
    const auto amplitudes = state.amplitude(), multiplier = state.multiplier();
    velocities_ = 12 * nodes + amplitudes.size();
    velocity_count_ = 6 * nodes + amplitudes.size();
    now_.resize(24 * nodes + 3 * amplitudes.size() + multiplier.size() + 5);
    Eigen::Index next = 0;
    const auto add = [&](const auto& numbers) {
      now_.segment(next, numbers.size()) = numbers;
      next += numbers.size();
    };
    for (int k = 0; k < nodes; ++k) add(Eigen::Map<const Eigen::Matrix<double, 12, 1>>(state.node(k).x.data()));
    add(amplitudes);
    for (int k = 0; k < nodes; ++k) add(Eigen::Map<const Vector6>(state.node(k).v.data()));
    add(state.amplitude_rate());
    for (int k = 0; k < nodes; ++k) add(Eigen::Map<const Vector6>(state.node(k).a.data()));
    add(state.amplitude_acceleration());
    add(multiplier);
    add(state.environment().gravity);
    now_.tail<2>() << state.environment().load_factor, state.time();
  }
  static_assert(sizeof(NodeState) == 24 * sizeof(double),
                "a node's state is an array of numbers: x R v Omega a Omega'");

  VectorX kept_, now_;
  Eigen::Index velocities_ = 0, velocity_count_ = 0;
};

}  // namespace bielle::mechanism
