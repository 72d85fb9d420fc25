#include "mechanism/solvers/constraints/activated_fit.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

void check_activated_fit(const System& system, const Environment& environment, const State& state,
                         const VectorX& memory) {
  if (!system.activities().any()) return;
  // The time of an event is located to a billionth of a step: gaps of this size are rounding errors of positions.
  constexpr double tolerance = 1e-6;
  double length = 0;  // computed when it is first needed
  VectorX r;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Slots& slots = system.slots()[m];
    if (slots.multipliers == 0 || !system.is_active(state, m)) continue;
    if (system.activities().is_active(memory, system.slots(), m)) continue;
    r.setZero(slots.size());
    system.model().members()[m].component->add_residual(LocalState(state, slots, environment), r);
    for (int row = 0; row < slots.multipliers; ++row) {
      const int multiplier = slots.multiplier_begin + row;
      const double gap = r[slots.multiplier_row() + row];
      const bool off = !state.idle.empty() && state.idle[static_cast<std::size_t>(multiplier)] == Idle::switched_off;
      if (off || gap == 0 || system.constraint_kind(multiplier) != ConstraintKind::holonomic) continue;
      if (length == 0) length = model_length(state);
      if (std::abs(gap) <= tolerance * constraint_size(system, environment, state, m, row, length)) continue;
      const int equation = system.size() - system.multipliers() + multiplier;
      throw ComputationError(
          fmt::format("t = {:.6g} s: {} cannot be activated: it is open by {:.4g} {}, and parts are joined where they "
                      "are; activate "
                      "it when they meet, or `lock` a joint that has been there from the beginning",
                      state.time, system.equation_name(equation), std::abs(gap), system.equation_units(equation)));
    }
  }
}

}  // namespace bielle::mechanism
