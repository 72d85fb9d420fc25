#include "mechanism/solvers/start/consistent_start.hpp"

#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/begin_first_order.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "mechanism/solvers/start/massless_balance.hpp"
#include "mechanism/solvers/start/massless_direction.hpp"

namespace bielle::mechanism {

StartReport make_consistent(const System& system, const Environment& environment, State& state) {
  StartReport report;
  assemble_positions(system, environment, state, report);
  system.begin_branch(state, environment);
  set_redundant_aside(system, environment, state);
  check_set_aside(system, environment, state);
  check_massless_directions(system, state);
  MassSaddle saddle(system);
  make_velocities_consistent(system, environment, state, report, saddle);
  begin_first_order(system, environment, state);
  make_accelerations_consistent(system, environment, state, saddle);
  // What follows from reactions is known only now, and may change them.
  constexpr int most = 20;
  for (int k = 0; k < most && begin_first_order(system, environment, state); ++k)
    make_accelerations_consistent(system, environment, state, saddle);
  balance_massless(system, environment, state, report);
  return report;
}

}  // namespace bielle::mechanism
