// The numbers of a local state that an evaluation of a superelement reads. Residual, tangent, energies and records of
// an accepted step refer to the same state: one evaluation serves all of them.
#pragma once

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class KnownState {
 public:
  /// Compares a state with the one that was kept, number by number, and remembers it for `keep`.
  bool is(const LocalState& state) {
    collect_unknowns(state);
    return known_ && kept_.size() == now_.size() && kept_ == now_;
  }
  void forget() { known_ = false; }
  /// Keeps the state that was compared last.
  void keep() {
    kept_ = now_;
    known_ = true;
  }

 private:
  void collect_unknowns(const LocalState& state) {
    constexpr Eigen::Index node_size = sizeof(NodeState) / sizeof(double);
    const auto nodes = static_cast<Eigen::Index>(state.slots().nodes.size());
    const auto amplitudes = state.amplitude(), multiplier = state.multiplier();
    now_.resize(node_size * nodes + 3 * amplitudes.size() + multiplier.size() + 5);
    Eigen::Index next = 0;
    const auto add = [&](const auto& numbers) {
      now_.segment(next, numbers.size()) = numbers;
      next += numbers.size();
    };
    for (int k = 0; k < nodes; ++k) add(Eigen::Map<const VectorX>(state.node(k).x.data(), node_size));
    add(amplitudes);
    add(state.amplitude_rate());
    add(state.amplitude_acceleration());
    add(multiplier);
    add(state.environment().gravity);
    now_.tail<2>() << state.environment().load_factor, state.time();
  }
  static_assert(sizeof(NodeState) == 24 * sizeof(double), "a node's state is an array of numbers");

  VectorX kept_, now_;
  bool known_ = false;
};

}  // namespace bielle::mechanism
