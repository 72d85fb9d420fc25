#include "mechanism/analyses/modes.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/analyses/delay_loops.hpp"
#include "mechanism/analyses/turning_equations.hpp"
#include "mechanism/solvers/linearised/growing_motions.hpp"
#include "mechanism/solvers/linearised/whirl.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

namespace {

[[noreturn]] void throw_undetermined(const System& system, const LinearisedEquations& equations, int at) {
  const int n = equations.unknowns();
  const std::string what = at < 0   ? "some unknown"
                           : at < n ? system.unknown_name(at)
                                    : system.unknown_name(n + equations.multiplier[static_cast<std::size_t>(at - n)]);
  throw ComputationError(
      fmt::format("there are no modes: nothing determines {} at any frequency: it has neither mass nor stiffness, and "
                  "nothing holds it, or constraints next to it are redundant",
                  what));
}

[[noreturn]] void throw_singular() {
  throw ComputationError(
      "there are no modes: some unknown is undetermined at every frequency (`eigen` of the mechanism at rest tells "
      "which)");
}

std::optional<int> outweighed(const System& system, const ModesReport& report, double rate) {
  if (report.axes == ModeAxes::turning) return count_outweighed(*report.equations, rate);
  return count_outweighed(linearised_equations(system, report.about.environment, report.about.state, ModeAxes::turning),
                          rate);
}

void scale_to_unit(const System& system, const State& state, std::vector<Mode>& modes) {
  for (Mode& mode : modes) {
    const std::complex<double> factor = unit_factor(system, state, mode);
    mode.u *= factor;
    mode.w *= factor;
  }
}

/// Adds up the energies of the harmonics of modes: means over a period and over a turn.
MemberEnergies energies_of_harmonics(const System& system, const ModesReport& report, double rate) {
  const HarmonicModes& harmonic = *report.harmonic;
  MemberEnergies sum(static_cast<Eigen::Index>(system.model().members().size()),
                     static_cast<Eigen::Index>(report.found.modes.size()));
  for (int k = -harmonic.harmonics; k <= harmonic.harmonics; ++k) {
    std::vector<Mode> modes = report.found.modes;
    for (std::size_t j = 0; j < modes.size(); ++j) {
      modes[j].u = harmonic.modes[j].u.col(k + harmonic.harmonics);
      modes[j].w = harmonic.modes[j].w.col(k + harmonic.harmonics);
      modes[j].s += std::complex<double>(0, k * rate);
    }
    sum += member_energies(system, report.about.environment, report.about.state, modes);
  }
  return sum;
}

/// Finds the modes of a mechanism with a part that turns behind a joint.
void find_turning_modes(const System& system, const ModesOptions& options, ModesReport& report) {
  const SteadyRotation& rotation = *options.rotation;
  const State& state = report.about.state;
  const TurningEquations equations(system, report.about, rotation);
  report.equations = std::make_shared<const LinearisedEquations>(equations.periodic.first());
  report.turning_axis = equations.part.axis(state);
  for (std::size_t k = 0; k < state.nodes.size(); ++k)
    report.turning_nodes.push_back(equations.part.turns(static_cast<int>(k)) ? 1 : 0);
  if (equations.negligible) {
    static_cast<LinearisedSetting&>(report) = equations.setting({});
    report.found = find_modes(*report.equations, options.search);
    scale_to_unit(system, state, report.found.modes);
    if (options.energies)
      report.energies = member_energies(system, report.about.environment, state, report.found.modes);
    return;
  }
  const HarmonicSearch search = equations.search();
  auto harmonic = std::make_shared<HarmonicModes>(search.find(options.search, options.harmonics));
  static_cast<LinearisedSetting&>(report) = equations.setting(*harmonic);
  report.found = harmonic->found();
  for (std::size_t k = 0; k < report.found.modes.size(); ++k) {
    Mode& mode = report.found.modes[k];
    HarmonicMode& amplitudes = harmonic->modes[k];
    mode.u = amplitudes.u.rowwise().sum();
    mode.w = amplitudes.w.rowwise().sum();
    const std::complex<double> factor = unit_factor(system, state, mode);
    mode.u *= factor;
    mode.w *= factor;
    amplitudes.u *= factor;
    amplitudes.w *= factor;
  }
  report.harmonic = harmonic;
  if (options.energies) report.energies = energies_of_harmonics(system, report, rotation.rate);
}

}  // namespace

ModesReport compute_modes(Session& session, const ModesOptions& options) {
  const System& system = session.system();
  ModesReport report;
  report.about = standing_state(session, options.rotation);
  const State& state = report.about.state;
  const Environment& environment = report.about.environment;
  if (options.rotation && options.rotation->joint) {
    try {
      find_turning_modes(system, options, report);
    } catch (const SingularEquations&) {
      throw_singular();
    }
    report.delays = describe_delays(session.model());
    return report;
  }
  static_cast<LinearisedSetting&>(report) = linearised_setting(system, environment, state, options.rotation);
  report.delays = describe_delays(session.model());
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
  scale_to_unit(system, state, report.found.modes);
  if (options.energies) report.energies = member_energies(system, environment, state, report.found.modes);
  return report;
}

double ModesReport::turning_whirl(const System& system, std::size_t mode) const {
  if (!turning || turning->periodicity == Periodicity::negligible) return NAN;
  if (harmonic && harmonic->harmonics > 0) return harmonic->modes[mode].whirl;
  const auto whirl = whirl_of(system, about.state, equations->M, found.modes[mode], turning_axis);
  return whirl ? std::copysign(1, turning->rate) * *whirl : NAN;
}

}  // namespace bielle::mechanism
