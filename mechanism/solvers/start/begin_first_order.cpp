#include "mechanism/solvers/start/begin_first_order.hpp"

#include <cmath>
#include <vector>

namespace bielle::mechanism {
namespace {

/// Adds a local vector's part of first-order rows to the unknowns. @returns whether one of them changed
bool move_first_order(const Slots& slots, const double* local, State& state) {
  bool moved = false;
  for (int k = 0; k < slots.first_orders; ++k) {
    double& y = state.first_order[slots.first_order_begin + k];
    const double before = y, change = local[slots.first_order_row() + k];
    y += change;
    constexpr double rounding = 1e-14;
    if (std::abs(change) > rounding * (std::abs(y) + std::abs(before))) moved = true;
  }
  for (std::size_t k = 0; k < slots.references.size(); ++k)
    if (move_first_order(*slots.references[k], local + slots.reference_rows[k], state)) moved = true;
  return moved;
}

/// Finds the members that have start values.
std::vector<std::size_t> find_beginning(const System& system) {
  std::vector<std::size_t> beginning;
  if (system.first_orders() == 0) return beginning;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    Declaration declaration;
    system.model().members()[m].component->declare(declaration);
    if (declaration.starts_by_state) beginning.push_back(m);
  }
  return beginning;
}

}  // namespace

bool begin_first_order(const System& system, const Environment& environment, State& state) {
  const std::vector<std::size_t> beginning = find_beginning(system);
  bool moved = false;
  // Each pass determines at least one more unknown of a chain.
  for (std::size_t pass = 0; pass <= beginning.size(); ++pass) {
    bool now = false;
    for (const std::size_t m : beginning) {
      if (!system.is_active(state, m)) continue;
      const Slots& slots = system.slots()[m];
      VectorX change = VectorX::Zero(slots.size());
      system.model().members()[m].component->add_start_values(LocalState(state, slots, environment), change);
      if (move_first_order(slots, change.data(), state)) now = true;
    }
    if (!now) break;
    moved = true;
  }
  return moved;
}

void count_as_not_begun(const System& system, const VectorX& memory, State& state) {
  for (const std::size_t m : find_beginning(system)) {
    const Slots& slots = system.slots()[m];
    state.memory.segment(slots.memory_begin, slots.memories) = memory.segment(slots.memory_begin, slots.memories);
  }
}

}  // namespace bielle::mechanism
