#include "mechanism/analyses/modes.hpp"

#include <fmt/format.h>

#include "mechanism/solvers/linearised/growing_motions.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

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

ModesReport compute_modes(Session& session, const ModesOptions& options) {
  const System& system = session.system();
  ModesReport report;
  report.about = standing_state(session, options.rotation);
  const State& state = report.about.state;
  const Environment& environment = report.about.environment;
  static_cast<LinearisedSetting&>(report) = linearised_setting(system, environment, state);
  if (options.axes) report.axes = *options.axes;
  report.equations =
      std::make_shared<const LinearisedEquations>(linearised_equations(system, environment, state, report.axes));
  const LinearisedEquations& equations = *report.equations;
  if (options.rotation) report.outweighed = outweighed(system, report, options.rotation->omega.norm());
  ModeOptions search = options.search;
  if (report.steadiness) {
    search.drift = report.steadiness->drift(report.axes);
    search.rate = report.steadiness->rate;
  }
  try {
    report.found = find_modes(equations, search);
  } catch (const SingularEquations& singular) {
    throw_undetermined(system, equations, singular.at());
  }
  for (Mode& mode : report.found.modes) {
    const std::complex<double> factor = unit_factor(system, state, mode);
    mode.u *= factor;
    mode.w *= factor;
  }
  if (options.energies) report.energies = member_energies(system, environment, state, report.found.modes);
  return report;
}

}  // namespace bielle::mechanism
