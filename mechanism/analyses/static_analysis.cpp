#include "mechanism/analyses/static_analysis.hpp"

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/newton_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

/// Reads `until: {load_factor: s}` or `{node: tip, displacement: d, direction: x}`.
PathEnd read_path_end(const YamlValue& entry, const Model& model) {
  entry.check_keys({"load_factor", "node", "displacement", "direction"}, "`until`");
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
    const std::string axis =
        direction->is_sequence() ? "" : direction->word({"x", "y", "z"}, "a direction (x, y, z or a vector)");
    end.direction = axis.empty() ? Vector3(direction->direction()) : Vector3::Unit(axis[0] - 'x');
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
  entry.check_keys({"until", "points"}, "`arc_length`");
  ContinuationOptions path;
  path.end = read_path_end(entry.at("until"), model);
  path.steps = steps;
  if (entry.has("points")) path.most_points = entry.at("points").integer();
  if (path.most_points < 1) entry.at("points").fail("expected at least 1");
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
    text += "  stability is not known: the stiffness is not symmetric, or forces depend on controllers or fluids\n";
  return text;
}

}  // namespace

std::unique_ptr<Analysis> read_static(const YamlValue& entry, const Model& model) {
  entry.check_keys({"type", "steps", "branch", "arc_length", "newton"}, "the analysis 'static'");
  StaticsOptions options;
  const auto path = entry.find("arc_length");
  if (path) options.steps = 0;
  if (const auto steps = entry.find("steps")) {
    const bool automatic = steps->is_scalar() && steps->text() == "auto";
    options.steps = automatic ? 0 : steps->integer();
    if (!automatic && options.steps < 1) steps->fail("expected at least one load step, or auto");
  }
  if (path) options.path = read_path(*path, options.steps, model);
  if (const auto branch = entry.find("branch")) {
    if (path) branch->fail("belongs to load steps; a path of `arc_length` goes on as it comes");
    options.branch = branch->positive_number();
    if (options.branch > 0.5) branch->fail("expected at most 0.5: it is relative to the mechanism's size");
  }
  options.newton = read_newton(entry, false);
  return std::make_unique<StaticAnalysis>(std::move(options));
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
