// Modes about the state that a session shows.
#include <fmt/format.h>

#include "mechanism/session/session.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/linearised/growing_motions.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/start/rigid_start.hpp"

namespace bielle::mechanism {

StandingState Session::standing() const {
  StandingState standing{*shown_, acting_, {}};
  State& state = standing.state;
  Environment& environment = standing.environment;
  const bool of_statics = environment.statics;
  environment.statics = false;
  state.held.clear();
  if (of_statics) {
    // At rest, whatever prescribed motions do at that time.
    system_.begin_motion(state, environment, false);
    system_.begin_branch(state, environment);
    set_redundant_aside(system_, environment, state);
    system_.begin_motion(state, environment, true);
    return standing;
  }
  system_.begin_motion(state, environment, false);
  if (const StartConditions conditions = start_conditions(); !conditions.empty()) {
    assemble_positions(system_, environment, state, standing.start, conditions);
    begin_velocities(system_, environment, state, conditions, standing.start);
  }
  standing.start.add(make_consistent(system_, environment, state));
  return standing;
}

namespace {

[[noreturn]] void throw_undetermined(const System& system, const LinearisedEquations& equations, int at) {
  const int n = equations.unknowns();
  const std::string what = at < 0   ? "some unknown"
                           : at < n ? system.unknown_name(at)
                                    : system.unknown_name(n + equations.multiplier[static_cast<std::size_t>(at - n)]);
  throw ComputationError(
      fmt::format("there are no modes: nothing determines {} whatever the frequency: it has neither mass nor "
                  "stiffness, and nothing "
                  "holds it, or constraints next to it are redundant",
                  what));
}

std::optional<int> outweighed(const System& system, const ModesReport& report, double rate) {
  if (report.axes == ModeAxes::turning) return count_outweighed(*report.equations, rate);
  return count_outweighed(linearised_equations(system, report.about.environment, report.about.state, ModeAxes::turning),
                          rate);
}

}  // namespace

ModesReport Session::modes(const ModesOptions& options) const {
  ModesReport report;
  report.about = standing();
  if (options.rotation) settle_in_rotation(system_, report.about.environment, *options.rotation, report.about.state);
  const State& state = report.about.state;
  const Environment& environment = report.about.environment;
  static_cast<LinearisedSetting&>(report) = linearised_setting(system_, environment, state);
  if (options.axes) report.axes = *options.axes;
  report.equations =
      std::make_shared<const LinearisedEquations>(linearised_equations(system_, environment, state, report.axes));
  const LinearisedEquations& equations = *report.equations;
  if (options.rotation) report.outweighed = outweighed(system_, report, options.rotation->omega.norm());
  ModeOptions search = options.search;
  if (report.steadiness) {
    search.drift = report.steadiness->drift(report.axes);
    search.rate = report.steadiness->rate;
  }
  try {
    report.found = find_modes(equations, search);
  } catch (const SingularEquations& singular) {
    throw_undetermined(system_, equations, singular.at());
  }
  for (Mode& mode : report.found.modes) {
    const std::complex<double> factor = unit_factor(system_, state, mode);
    mode.u *= factor;
    mode.w *= factor;
  }
  if (options.energies) report.energies = member_energies(system_, environment, state, report.found.modes);
  return report;
}

}  // namespace bielle::mechanism
