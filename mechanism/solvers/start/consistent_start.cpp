#include "mechanism/solvers/start/consistent_start.hpp"

#include <algorithm>

#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/begin_first_order.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "mechanism/solvers/start/massless_balance.hpp"
#include "mechanism/solvers/start/massless_direction.hpp"
#include "mechanism/solvers/start/one_sided_holds.hpp"
#include "mechanism/solvers/start/refused_holds.hpp"

namespace bielle::mechanism {

namespace {

/// Releases overloaded holds, the most overloaded first.
void release_overloaded(const System& system, const Environment& environment, State& state, StartReport& report,
                        KktMatrix& saddle) {
  const auto& events = system.event_functions();
  const auto count = static_cast<int>(events.size());
  const bool any = std::any_of(events.begin(), events.end(), [](const auto& c) { return c.function.one_by_one; });
  if (!any) return;
  VectorX values(count);
  // Each hold is released only once; holds that engage again are left to the motion.
  for (int k = 0; k < count; ++k) {
    system.calc_event_functions(state, environment, values);
    int worst = -1;
    for (int i = 0; i < count; ++i)
      if (events[static_cast<std::size_t>(i)].function.one_by_one && values[i] < 0 &&
          (worst < 0 || values[i] < values[worst]))
        worst = i;
    if (worst < 0) return;
    system.begin_branch(state, environment, {worst});
    set_redundant_aside(system, environment, state);
    refuse_holds(system, environment, state, active_holds(system, state), Overloaded::holds, saddle);
    make_velocities_consistent(system, environment, state, report, saddle);
    make_accelerations_consistent(system, environment, state, saddle);
  }
}

}  // namespace

StartReport make_consistent(const System& system, const Environment& environment, State& state) {
  StartReport report;
  system.begin_motion(state, environment, false);
  assemble_positions(system, environment, state, report);
  system.begin_branch(state, environment);
  set_redundant_aside(system, environment, state);
  check_set_aside(system, environment, state);
  check_massless_directions(system, state);
  KktMatrix saddle(system);
  make_velocities_consistent(system, environment, state, report, saddle);
  if (system.begin_motion(state, environment, true)) {
    set_redundant_aside(system, environment, state);
    make_velocities_consistent(system, environment, state, report, saddle);
  }
  begin_first_order(system, environment, state);
  refuse_holds(system, environment, state, active_holds(system, state), Overloaded::holds, saddle);
  const State begun = state;
  make_accelerations_consistent(system, environment, state, saddle);
  exchange_one_sided(system, environment, begun, state, report, saddle);
  // Start values that depend on reactions can only be computed now, and may change the reactions.
  constexpr int most = 20;
  for (int k = 0; k < most && begin_first_order(system, environment, state); ++k)
    make_accelerations_consistent(system, environment, state, saddle);
  release_overloaded(system, environment, state, report, saddle);
  balance_massless(system, environment, state, report);
  return report;
}

}  // namespace bielle::mechanism
