#include "mechanism/analyses/eigen_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/mode_arrays.hpp"
#include "mechanism/analyses/mode_names.hpp"
#include "mechanism/analyses/rotation_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::size_t most_listed = 50;

/// Lists the parts with a rounded share of 5 % of the energy or more, the largest first: "element 'rod' 93 %, joint
/// 'main' 6 %". Parts with equal percentages keep the order of the model, which rounding errors do not change.
std::string main_parts(const ModeParts& parts, Eigen::Index mode) {
  std::vector<std::pair<long, std::string>> percents;
  for (Eigen::Index k = 0; k < parts.share.rows(); ++k)
    if (const long percent = std::lround(100 * parts.share(k, mode)); percent >= 5)
      percents.emplace_back(percent, parts.names[static_cast<std::size_t>(k)]);
  std::stable_sort(percents.begin(), percents.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  constexpr std::size_t most = 3;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(most, percents.size()); ++k)
    words.push_back(fmt::format("{} {} %", percents[k].second, percents[k].first));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Returns the damping ratio, 0 if it cannot be distinguished from zero.
double shown_damping(const Mode& mode) {
  constexpr double rounding = 1e-10;
  const bool nothing = std::abs(mode.s.real()) <= std::max(mode.uncertainty, rounding * std::abs(mode.s));
  return nothing ? 0 : mode.damping_ratio();
}

/// Describes the uncertainty of eigenvalues that rounding errors determine only roughly.
std::string format_uncertain(const ModesReport& report) {
  const std::vector<Mode>& modes = report.found.modes;
  const double drift = report.steadiness ? report.steadiness->drift(report.axes) * report.steadiness->rate : 0;
  constexpr double well_known = 1e-3;
  std::string text;
  double slowest = INFINITY, resolution = 0;
  for (const Mode& mode : modes) {
    if (mode.kind == ModeKind::rigid)
      resolution = std::max(resolution, mode.uncertainty);
    else
      slowest = std::min(slowest, std::abs(mode.s));
  }
  if (std::isfinite(slowest) && resolution > well_known * slowest)
    text += fmt::format(
        "  what moves more slowly than {:.2g} Hz cannot be told from rigid motions: rounding of the "
        "stiffness is as much\n",
        resolution / (2 * std::numbers::pi));
  for (std::size_t k = 0; k < std::min(most_listed, modes.size()); ++k)
    if (modes[k].kind != ModeKind::rigid && modes[k].uncertainty > well_known * std::abs(modes[k].s))
      text += fmt::format("  mode {}: {} leaves its eigenvalue uncertain by {:.2g} 1/s, {:.2g} % of it\n", k + 1,
                          drift > 0.1 * modes[k].uncertainty ? "the motion, which is not quite steady," : "rounding",
                          modes[k].uncertainty, 100 * modes[k].uncertainty / std::abs(modes[k].s));
  return text;
}

std::string format_table(const ModesReport& report, const ModeParts& parts, const std::vector<std::string>& names) {
  std::string text =
      fmt::format("  {:>4}  {:>13}  {:>11}  {:<11}  {}\n", "mode", "frequency", "damping", "kind", "motion; energy in");
  const std::vector<Mode>& modes = report.found.modes;
  for (std::size_t k = 0; k < std::min(most_listed, modes.size()); ++k)
    text += fmt::format("  {:>4}  {:>10.6g} Hz  {:>11.4g}  {:<11}  {}{}{}\n", k + 1, modes[k].frequency(),
                        shown_damping(modes[k]), mode_kind_name(modes[k].kind), names[k], names[k].empty() ? "" : "; ",
                        main_parts(parts, static_cast<Eigen::Index>(k)));
  if (modes.size() > most_listed) text += fmt::format("  and {} more\n", modes.size() - most_listed);
  return text;
}

/// Formats the warnings.
std::string format_remarks(const ModesReport& report) {
  std::string text;
  std::vector<std::string> growing;
  double fastest = 0;
  long rigid = 0;
  for (std::size_t k = 0; k < report.found.modes.size(); ++k) {
    const Mode& mode = report.found.modes[k];
    if (mode.kind == ModeKind::rigid) ++rigid;
    if (mode.kind != ModeKind::growing) continue;
    growing.push_back(fmt::format("{}", k + 1));
    fastest = std::max(fastest, mode.s.real());
  }
  if (!growing.empty())
    text += fmt::format("  UNSTABLE: {} {} {}, the fastest to twice its size within {:.3g} s\n",
                        growing.size() == 1 ? "mode" : "modes", fmt::join(growing, ", "),
                        growing.size() == 1 ? "grows" : "grow", std::numbers::ln2 / fastest);
  if (const int besides = report.found.growing_besides.value_or(0); besides > 0)
    text += fmt::format("  UNSTABLE: {} {} that {} not among these modes\n",
                        counted(besides, growing.empty() ? "motion" : "more motion"), besides == 1 ? "grows" : "grow",
                        besides == 1 ? "is" : "are");
  if (report.outweighed.value_or(0) > 0)
    text += fmt::format(
        "  above a critical speed: along {}, seen in axes that turn, centrifugal forces exceed the restoring forces; "
        "there the mechanism deflects against its unbalance, and Coriolis forces alone may keep it stable\n",
        counted(*report.outweighed, "motion"));
  if (rigid > 0) text += fmt::format("  {}: no force resists\n", counted(rigid, "rigid mode"));
  text += format_uncertain(report);
  text += format_setting(report, "modes");
  return text;
}

}  // namespace

const KeyTable& eigen_keys() {
  using namespace keys;
  static const KeyTable table{
      "the analysis 'eigen'",
      "Modes of small motions about the present state.",
      {analysis_type_key("eigen"),
       {"count", integer().at_least(1), otherwise("20"),
        "Number of modes: the slowest besides rigid ones, or the nearest to `near`."},
       {"near", number("Hz").positive(), optional, "Frequency around which modes are sought."},
       {"below", number("Hz").positive(), optional, "Limit of frequencies below which all modes are found."},
       rotation_key(),
       {"shapes", boolean(), otherwise("true"), "Whether the shapes of the modes are recorded."}}};
  return table;
}

std::unique_ptr<Analysis> read_eigen(const YamlValue& entry, const Model& model) {
  ModesOptions all;
  ModeOptions& options = all.search;
  options.count = entry.at("count").integer();
  if (const auto near = entry.find("near")) options.near = near->number();
  if (const auto below = entry.find("below")) {
    if (options.near)
      below->fail("give either `near`, a frequency around which modes are sought, or `below`, their limit");
    if (entry.has("count")) below->fail("all modes below a frequency are found, however many: leave `count` out");
    options.below = below->number();
  }
  if (const auto rotation = entry.find("rotation")) all.rotation = read_rotation(*rotation, model);
  return std::make_unique<EigenAnalysis>(std::move(all), entry.at("shapes").boolean());
}

void EigenAnalysis::solve(Session& session, AnalysisSummary& summary) const {
  const ModesReport report = compute_modes(session, options_);
  const ModeParts parts = mode_parts(session.model(), report);
  const std::vector<Mode>& modes = report.found.modes;
  write_modes(session, report, parts, shapes_);
  for (const Mode& mode : modes) {
    summary.numbers["frequency"].push_back(mode.frequency());
    summary.numbers["damping_ratio"].push_back(mode.damping_ratio());
    summary.numbers["real"].push_back(mode.s.real());
    summary.numbers["imaginary"].push_back(mode.s.imag());
  }
  const Environment& environment = report.about.environment;
  summary.text = fmt::format(
      "eigen, {} about the state at t = {:.6g} s{}\n", counted(modes.size(), "mode"), report.about.state.time,
      environment.load_factor == 1 ? "" : fmt::format(", load factor {:.6g}", environment.load_factor));
  summary.text += format_start(report.about.start);
  if (!modes.empty()) {
    const std::vector<std::string> names = full_names(describe_modes(session.system(), report), !options_.search.near);
    session.write(ResultNames{"eigen/name", names});
    summary.text += format_table(report, parts, names);
  }
  const auto moving =
      std::count_if(modes.begin(), modes.end(), [](const Mode& mode) { return mode.kind != ModeKind::rigid; });
  if (report.found.all)
    summary.text += modes.empty() ? "  nothing can move\n" : "  these are all modes of the mechanism\n";
  else if (report.harmonic && report.turning->unresolved == 0 && !options_.search.below &&
           moving < options_.search.count)
    summary.text += fmt::format(
        "  warning: {} of the {} modes that were asked for were found: another motion resembles a copy of one of "
        "these, whose frequency differs by a "
        "multiple of the rate; `near: FREQUENCY` or another rate shows it\n",
        moving, options_.search.count);
  summary.text += format_remarks(report);
}

}  // namespace bielle::mechanism
