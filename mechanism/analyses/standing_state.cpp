#include "mechanism/analyses/standing_state.hpp"

#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/start/rigid_start.hpp"
#include "mechanism/system/echoes.hpp"

namespace bielle::mechanism {
namespace {

StandingState present_state(const Session& session) {
  const System& system = session.system();
  StandingState standing{session.state(), session.acting(), {}};
  State& state = standing.state;
  Environment& environment = standing.environment;
  const bool of_statics = environment.statics;
  environment.statics = false;
  state.held.clear();
  Echoes(system).forget(state);
  if (of_statics) {
    // The state is at rest, even if prescribed motions have a velocity at that time.
    system.begin_motion(state, environment, false);
    system.begin_branch(state, environment);
    set_redundant_aside(system, environment, state);
    system.begin_motion(state, environment, true);
    return standing;
  }
  system.begin_motion(state, environment, false);
  if (const StartConditions conditions = session.start_conditions(); !conditions.empty()) {
    assemble_positions(system, environment, state, standing.start, conditions);
    begin_velocities(system, environment, state, conditions, standing.start);
  }
  standing.start.add(make_consistent(system, environment, state));
  return standing;
}

}  // namespace

StandingState standing_state(Session& session, const std::optional<SteadyRotation>& rotation) {
  StandingState standing = present_state(session);
  if (!rotation) return standing;
  settle_in_rotation(session.system(), standing.environment, *rotation, standing.state);
  session.gather(standing.state, standing.environment);
  return standing;
}

}  // namespace bielle::mechanism
