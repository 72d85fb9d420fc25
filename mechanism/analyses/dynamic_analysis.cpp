#include "mechanism/analyses/dynamic_analysis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/coordinate_reader.hpp"
#include "mechanism/analyses/newton_reader.hpp"
#include "mechanism/analyses/step_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/session/time_grid.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

Scheme read_scheme(const YamlValue& entry, std::string& description) {
  const std::string name = entry.at("scheme").word();
  const auto refuse = [&](const char* key) {
    if (entry.has(key)) entry.at(key).fail(fmt::format("is no parameter of the scheme '{}'", name));
  };
  if (name == "generalized_alpha") {
    refuse("alpha");
    const double rho = entry.at("rho").number();
    description = fmt::format("generalised-alpha, rho = {}", rho);
    return Scheme::generalized_alpha(rho);
  }
  refuse("rho");
  if (name == "hht") {
    const double alpha = entry.at("alpha").number();
    description = fmt::format("HHT, alpha = {}", alpha);
    return Scheme::hht(alpha);
  }
  refuse("alpha");
  description = "Newmark (trapezoidal rule)";
  return Scheme::newmark();
}

/// Reads `step`: steps are fixed if it is given alone. With `tolerance` they are adaptive, and `step` is the first.
StepOptions read_stepping(const YamlValue& entry, double duration) {
  StepOptions options;
  const auto largest = entry.find("largest_step");
  if (entry.has("tolerance")) {
    options.tolerance = entry.at("tolerance").number();
    options.size = entry.has("step") ? entry.at("step").number() : 1e-4 * duration;
    if (largest) options.largest = largest->number();
    if (options.size > options.largest)
      entry.at("step").fail(
          fmt::format("{:.6g} s is longer than the largest step, {:.6g} s", options.size, options.largest));
  } else {
    options.size = entry.at("step").number();
    if (largest) largest->fail("is for adaptive steps: give a `tolerance` as well");
  }
  check_step(entry, entry.has("step") ? "step" : "duration", options.size, duration);
  return options;
}

/// Fraction of the largest energy: the summary warns if errors, or the scheme's dissipation, exceed it in the energy
/// balance.
constexpr double worth_a_warning = 0.05;
/// No scheme adds energy to a motion that its steps resolve; the summary therefore mentions a gain above this fraction
/// of the largest energy.
constexpr double gained = 0.01;

/// Returns the energy below which a change is not significant [J]: the work of the largest forces along 1e-9 of the
/// model's size, to which Newton's method determines positions. Reactions are left out: they do no work, and may have
/// any size if joints act against each other.
double force_noise(const Session& session) {
  constexpr double positions = 1e-9;
  State state = session.state();
  state.multiplier.setZero();
  VectorX r(session.system().size());
  ResidualScale scale;
  session.system().residual(state, session.environment(), r, &scale);
  return positions * (scale[Kind::translation] * model_length(state) + scale[Kind::rotation]);
}

/// Returns an energy below which energies are not significant [J]: velocities that joints stop at the start retain
/// rounding errors of the given ones, which are at most this fraction of them.
double velocity_noise(const Session& session) {
  constexpr double velocities = 1e-12;
  return velocities * velocities * session.system().energy(session.system().start(0), session.environment()).kinetic;
}

/// Describes sizes and iterations of the steps, and steps that were rejected or shortened.
std::string format_march(const MarchLog& log, const System& system) {
  std::string text;
  if (log.most_iterations > 0)
    text += fmt::format(
        "  {}; at most {}, at t = {:.6g} s{}\n", counted(log.factorisations, "factorisation"),
        counted(log.most_iterations, "iteration"), log.most_iterations_at,
        log.slowest_equation < 0 ? "" : " (worst residual: " + system.equation_name(log.slowest_equation) + ")");
  if (log.shortened > 0)
    text += fmt::format("  {} shortened by the line search\n", counted(log.shortened, "iteration"));
  if (log.steps > 0 && log.largest > log.smallest * (1 + 1e-6))
    text += fmt::format("  steps from {:.3g} to {:.3g} s\n", log.smallest, log.largest);
  if (log.refused_by_error > 0)
    text += fmt::format("  {} refused for the local error\n", counted(log.refused_by_error, "step"));
  if (log.refused_by_newton > 0)
    text += fmt::format("  {} refused because Newton's method failed; the last: {}\n",
                        counted(log.refused_by_newton, "step"), log.hardest);
  return text;
}

std::string format_events(const Motion& motion) {
  const long count = motion.log().crossings;
  if (count == 0) return {};
  return fmt::format("  {}, the last: {}{}\n", counted(count, "event"), motion.last_event(),
                     motion.stopped_by_event() ? ", which stopped the run" : "");
}

/// Energy that is supplied and dissipated in the same step cancels, and leaves no error: if more energy flows through
/// in a step than is stored, the error is compared with this fraction of the flow.
constexpr double part_of_turnover = 0.1;

/// Surplus of the energy balance relative to the largest energy that was stored or that flowed through. A negative
/// value means missing energy.
struct Gap {
  double whole, scheme;  ///< whole surplus; part of it due to the scheme's own dissipation
  double turnover;       ///< largest error of one turnover of the stored energy, relative to that energy
  double errors() const { return whole - scheme; }
};

std::string explain_gap(const Gap& gap, const Scheme& scheme) {
  if (SchemeLoss::is_of(scheme))
    return fmt::format("{:.2g} by the scheme's own dissipation, {:+.2g} by errors of the steps", gap.scheme,
                       gap.errors());
  return gap.whole > 0 ? "gained by errors of the steps; this scheme does not dissipate"
                       : "lost by errors of the steps; this scheme does not dissipate";
}

/// @param tolerance  tolerance of adaptive steps; 0: fixed steps
std::string judge_gap(const Gap& gap, double tolerance) {
  const char* const advice = tolerance > 0 ? "give a smaller `tolerance`" : "take smaller steps, or give a `tolerance`";
  std::string text;
  if (std::max(std::abs(gap.errors()), gap.turnover) > worth_a_warning)
    text =
        "  warning: such large errors in the balance mean that the steps are too long for the motion, or that the "
        "motion jumps\n";
  else if (gap.whole > gained)
    text = fmt::format("  energy grows: {}\n", advice);
  else if (gap.errors() > gained)
    text = fmt::format("  errors of the steps add energy, which the scheme's dissipation hides: {}\n", advice);
  if (gap.scheme < -worth_a_warning)
    text += fmt::format(
        "  warning: the scheme's own dissipation took {:.0f} % of the largest energy: unless what it damps does not "
        "matter, take smaller steps, or a scheme that dissipates less (`rho` closer to 1)\n",
        -100 * gap.scheme);
  return text;
}

/// Returns a line for the summary if the error of the balance is a considerable part of the energy that went in or was
/// dissipated. This error would look small relative to a larger stored energy.
std::string judge_flow(double balance, double stored, double through) {
  constexpr double least = 1e-3;  // fraction of the stored energy: with smaller flows, losses are not judged
  if (through >= stored || through < least * stored || std::abs(balance) <= worth_a_warning * through) return {};
  return fmt::format(
      "  that is {:.2g} of the {:.3g} J that went in or were dissipated: these are not known more accurately\n",
      std::abs(balance) / through, through);
}

std::string format_energy(const Session& session, const Motion& motion, const DynamicsOptions& options) {
  const Energy& energy = motion.energy();
  const EnergyBalance& energy_balance = motion.energy_balance();
  const double balance = energy_balance.balance(), stored = energy_balance.largest(),
               through = energy_balance.through();
  const double largest = std::max(stored, through);
  const std::string text = format_energies(energy);
  if (!(largest > std::max(force_noise(session), velocity_noise(session)))) return text + "  nothing moved\n";
  const Gap gap{
      balance / largest, 0 - motion.scheme_loss() / largest,
      energy_balance.largest_error() / std::max(stored, part_of_turnover * energy_balance.largest_turnover())};
  return text +
         fmt::format("  balance {:.3g} J, {:.2g} of {} ({})\n", balance, gap.whole,
                     through > stored ? "what flowed through" : "the largest energy",
                     explain_gap(gap, options.scheme)) +
         judge_gap(gap, options.stepping.tolerance) + judge_flow(balance, stored, through);
}

}  // namespace

namespace {

const KeyTable& start_keys() {
  using namespace keys;
  static const KeyTable table{
      "a start",
      "Start in static equilibrium.",
      {{"equilibrium", boolean(), required, "Whether the motion starts in static equilibrium under the loads."},
       {"hold", list_of(KeyForms{name_of("joint"), state_formula("any", {}), nested(kept_coordinate_keys)}), optional,
        "Joints, or coordinates of joints as `joint.coordinate`, that keep their values while the rest comes into "
        "equilibrium."}}};
  return table;
}

/// Reads `start: as_given`, `start: equilibrium`, or `start: {equilibrium: true, hold: [shaft]}`.
void read_start(const YamlValue& start, const Model& model, DynamicsOptions& options) {
  if (!start.is_map()) {
    options.equilibrium = start.word() == "equilibrium";
    return;
  }
  options.equilibrium = start.at("equilibrium").boolean();
  const auto hold = start.find("hold");
  if (!hold) return;
  if (!options.equilibrium) hold->fail("is what stays while the rest comes into equilibrium: give `equilibrium: true`");
  options.held = read_held_coordinates(*hold, model);
}

}  // namespace

const KeyTable& dynamic_keys() {
  using namespace keys;
  static const KeyTable table{
      "the analysis 'dynamic'",
      "Motion by integration in time.",
      {analysis_type_key("dynamic"),
       {"duration", number("s").positive(), required, "Duration of the motion."},
       {"step", number("s").positive(), computed("with `tolerance` 1e-4 of the duration; else it is required"),
        "Length of the steps; with `tolerance`, that of the first one."},
       {"tolerance", number().inside(0, 1), optional,
        "Error of each adaptive step, relative to the size of the mechanism; without it steps are of equal length."},
       {"largest_step", number("s").positive(), optional, "Greatest length of adaptive steps."},
       {"scheme", word({"generalized_alpha", "hht", "newmark"}, "a scheme"), otherwise("generalized_alpha"),
        "Scheme of integration."},
       {"rho", number().between(0, 1), otherwise("0.8"),
        "Spectral radius of `generalized_alpha` at infinite frequency; 1 is without dissipation."},
       {"alpha", number().between(0, 1.0 / 3), otherwise("0.1"), "Parameter of `hht`; 0 is without dissipation."},
       {"constraints", word({"corrected", "position", "stabilized"}, "a form of constraints"), otherwise("corrected"),
        "Form of the joints' constraints: `corrected` positions and, in fast turns, velocities; `stabilized` positions "
        "and velocities together; `position` alone."},
       {"start",
        {word({"as_given", "equilibrium"}, "a start"), nested(start_keys)},
        otherwise("as_given"),
        "Positions at the start: `as_given`, or in static `equilibrium` under the loads."},
       dynamic_newton_key()}};
  return table;
}

std::unique_ptr<Analysis> read_dynamic(const YamlValue& entry, const Model& model) {
  DynamicsOptions options;
  options.duration = entry.at("duration").number();
  options.stepping = read_stepping(entry, options.duration);
  std::string scheme;
  options.scheme = read_scheme(entry, scheme);
  options.newton = read_newton(entry);
  read_start(entry.at("start"), model, options);
  const std::string form = entry.at("constraints").word();
  if (form == "position") {
    options.form = ConstraintForm::position;
    scheme += ", constraints of positions alone";
  } else if (form == "stabilized") {
    options.form = ConstraintForm::stabilised;
    scheme += ", stabilised constraints";
  }
  return std::make_unique<DynamicAnalysis>(std::move(options), std::move(scheme));
}

std::size_t DynamicAnalysis::expected_rows(const Recording& recording) const {
  if (!recording.times.empty()) return recording.times.size() + 1;
  if (options_.stepping.tolerance > 0) return 0;
  return static_cast<std::size_t>(grid_steps(options_.duration, options_.stepping.size) / recording.every) +
         2;  // the first and the last row
}

void DynamicAnalysis::solve(Session& session, AnalysisSummary& summary) const {
  Motion motion = session.dynamics(options_);
  finish(session, motion, fmt::format("dynamic, {}\n", scheme_), summary);
}

void DynamicAnalysis::solve_rest(Session& session, const std::vector<double>& checkpoint, ResultSink& sink,
                                 AnalysisSummary& summary) const {
  Motion motion = session.dynamics(options_, checkpoint, sink);
  finish(session, motion, fmt::format("dynamic, {}, continued from t = {:.6g} s\n", scheme_, motion.time()), summary);
}

void DynamicAnalysis::finish(Session& session, Motion& motion, const std::string& heading,
                             AnalysisSummary& summary) const {
  motion.finish();
  const MarchLog& log = motion.log();
  summary.records = session.rows();
  summary.numbers["end_time"] = {motion.time()};
  summary.numbers["steps"] = {static_cast<double>(log.steps)};
  summary.numbers["balance"] = {motion.balance()};
  summary.text = heading + format_start(motion.start()) + format_mobility(session);
  if (log.steps > 0)
    summary.text += format_steps(log.steps, log.iterations, summary.records) +
                    fmt::format(", until t = {:.6g} s\n", motion.time()) + format_march(log, session.system()) +
                    format_events(motion) + format_energy(session, motion, options_);
  else
    summary.text += format_events(motion);  // an event at the start may have stopped the run
  for (const std::string& warning : motion.warnings()) summary.text += fmt::format("  warning: {}\n", warning);
}

}  // namespace bielle::mechanism
