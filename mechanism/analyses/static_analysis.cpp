#include "mechanism/analyses/static_analysis.hpp"

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/direction_reader.hpp"
#include "mechanism/analyses/newton_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& until_keys() {
  using namespace keys;
  static const KeyTable table{
      "`until`",
      "End of a path of equilibria: a load factor, or the displacement of a node.",
      {{"load_factor", number(), optional, "Load factor at which the path ends."},
       {"node", name_of("node"), optional, "Node whose displacement ends the path."},
       {"displacement", number("m"), optional,
        "Displacement of the node from its drawn position; without a direction, its distance from there."},
       {"direction", direction_forms(), optional, "Inertial direction of the displacement: x, y, z or a vector."}}};
  return table;
}

const KeyTable& arc_length_keys() {
  using namespace keys;
  static const KeyTable table{
      "`arc_length`",
      "A path of equilibria past limit points of the load.",
      {{"until", nested(until_keys), required, "End of the path."},
       {"points", integer().at_least(1), otherwise("1000"), "Largest number of points of the path."}}};
  return table;
}

/// Reads `until: {load_factor: s}` or `{node: tip, displacement: d, direction: x}`.
PathEnd read_path_end(const YamlValue& entry, const Model& model) {
  PathEnd end;
  const bool by_node = entry.has("node") || entry.has("displacement") || entry.has("direction");
  if (entry.has("load_factor") == by_node)
    entry.fail("a path ends either at a `load_factor` or at the `displacement` of a `node`: give one of the two");
  if (!by_node) {
    end.load_factor = entry.at("load_factor").number();
    return end;
  }
  end.node = node_named_by(entry.at("node"), model);
  end.displacement = entry.at("displacement").number();
  if (const auto direction = entry.find("direction")) {
    end.direction = read_direction(*direction);
  } else if (end.displacement <= 0) {
    entry.at("displacement")
        .fail("expected a positive number: without `direction` it is the distance from where the node is drawn [m]");
  }
  bool held = true;
  for (std::size_t k = 0; k < 3; ++k)
    if (model.node(end.node).freedom[k] != Freedom::fixed &&
        (end.direction.isZero(0) || end.direction[static_cast<Eigen::Index>(k)] != 0))
      held = false;
  if (held) entry.at("node").fail("this node is fixed: it has no such displacement");
  return end;
}

/// Reads `arc_length: {until: {..}, points: 1000}`.
ContinuationOptions read_path(const YamlValue& entry, int steps, const Model& model) {
  ContinuationOptions path;
  path.end = read_path_end(entry.at("until"), model);
  path.steps = steps;
  path.most_points = entry.at("points").integer();
  return path;
}

/// Describes changes of stability, and the final stability.
std::string format_stability(const StaticsLog& log, bool path, bool hint) {
  std::string text;
  for (const CriticalPoint& point : log.critical)
    text += fmt::format("  {} at load factor {:.9g}: the stiffness {} along {}, most at {}{}\n",
                        path                         ? "bifurcation"
                        : point.after > point.before ? "instability"
                                                     : "stability again",
                        point.factor, point.after > point.before ? "becomes negative" : "is positive again",
                        counted(std::abs(point.after - point.before), "motion") +
                            (std::abs(point.after - point.before) > 1 ? " at once" : ""),
                        point.motion,
                        !point.left                      ? ""
                        : point.after - point.before > 1 ? "; of the branches that leave there one was followed"
                                                         : "; the branch that leaves there was followed");
  if (log.unstable.value_or(0) > 0)
    text += fmt::format("  the equilibrium at the end is unstable: its stiffness is negative along {}{}\n",
                        counted(*log.unstable, "motion"),
                        log.critical.empty() || !hint ? "" : "; `branch: 1e-3` follows the branch that leaves there");
  for (const LoadJump& jump : log.jumps)
    text += fmt::format(
        "  jump at load factor {:.6g}: no equilibrium is near beyond it, and the one that was found is {:.3g} m away "
        "at node '{}'; `arc_length` follows the path in between\n",
        jump.factor, jump.distance, jump.node);
  if (!log.fell.empty()) text += fmt::format("  let go until it rested elsewhere: {}\n", log.fell);
  if (!log.loose.empty()) text += format_loose(log.loose);
  if (!log.unstable && log.critical.empty() && !path)
    text += fmt::format("  stability is not known: {}\n", log.why_not_known);
  return text;
}

}  // namespace

const KeyTable& static_keys() {
  using namespace keys;
  static const KeyTable table{
      "the analysis 'static'",
      "Equilibrium under the loads, which grow with the load factor.",
      {analysis_type_key("static"),
       {"steps",
        {integer().at_least(1), word({"auto"}, "a number of load steps")},
        computed("1; `auto` with `arc_length`"),
        "Number of equal increments of the load factor, or `auto`."},
       {"branch", number().positive().at_most(0.5), optional,
        "Deflection by which a load step leaves an equilibrium that becomes unstable, relative to the mechanism's size "
        "(or in radians)."},
       {"arc_length", nested(arc_length_keys), optional,
        "Path of equilibria that is followed past limit points of the load, in place of load steps."},
       newton_key()}};
  return table;
}

std::unique_ptr<Analysis> read_static(const YamlValue& entry, const Model& model) {
  StaticsOptions options;
  const auto path = entry.find("arc_length");
  if (path) options.steps = 0;
  if (const auto steps = entry.find("steps")) {
    const bool automatic = steps->is_scalar() && steps->text() == "auto";
    options.steps = automatic ? 0 : steps->integer();
  }
  if (path) options.path = read_path(*path, options.steps, model);
  if (const auto branch = entry.find("branch")) {
    if (path) branch->fail("belongs to load steps; a path of `arc_length` goes on as it comes");
    options.branch = branch->number();
  }
  options.newton = read_newton(entry);
  return std::make_unique<StaticAnalysis>(std::move(options));
}

std::string StaticAnalysis::place(const Session& session) const {
  return fmt::format("load factor {:.6g}", session.loaded().factor);
}

void StaticAnalysis::solve(Session& session, AnalysisSummary& summary) const {
  const StaticsReport report = compute_statics(session, options_);
  summary.records = session.rows();
  summary.numbers["load_factor"] = {report.load_factor};
  summary.numbers["limit_points"] = report.limit_points;
  summary.text = options_.path ? fmt::format("static, arc length, {} to load factor {:.6g}\n",
                                             counted(report.points, "point"), report.load_factor)
                               : fmt::format("static, {}\n", counted(report.points, "load step"));
  summary.text += format_start(report.start) + format_mobility(session);
  if (report.points == 0) return;
  summary.text += format_steps(report.points, report.iterations, summary.records) + "\n";
  if (report.log.refused > 0)
    summary.text += fmt::format("  {} refused ({} in all); the last, to load factor {:.6g}: {}\n",
                                counted(report.log.refused, "increment"), counted(report.log.solves, "iteration"),
                                report.log.refused_at, report.log.why_refused);
  summary.text += format_stability(report.log, options_.path.has_value(), !options_.path && options_.branch == 0);
  for (const CriticalPoint& point : report.log.critical) summary.numbers["critical_points"].push_back(point.factor);
  for (const double factor : report.limit_points)
    summary.text += fmt::format("  limit point at load factor {:.9g}\n", factor);
}

}  // namespace bielle::mechanism
