#include "mechanism/io/analysis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

Scheme read_scheme(const YamlValue& entry, std::string& description) {
  const std::string name = entry.has("scheme")
                               ? entry.at("scheme").word({"generalized_alpha", "hht", "newmark"}, "a scheme")
                               : std::string("generalized_alpha");
  const auto refuse = [&](const char* key) {
    if (entry.has(key)) entry.at(key).fail(fmt::format("is no parameter of the scheme '{}'", name));
  };
  const auto in_range = [&](const char* key, double fallback, double least, double most) {
    if (!entry.has(key)) return fallback;
    const double value = entry.at(key).number();
    if (value < least || value > most)
      entry.at(key).fail(fmt::format("expected a number from {} to {:.4g}, found {}", least, most, value));
    return value;
  };
  if (name == "generalized_alpha") {
    refuse("alpha");
    const double rho = in_range("rho", 0.8, 0, 1);
    description = fmt::format("generalised-alpha, rho = {}", rho);
    return Scheme::generalized_alpha(rho);
  }
  refuse("rho");
  if (name == "hht") {
    const double alpha = in_range("alpha", 0.1, 0, 1.0 / 3);
    description = fmt::format("HHT, alpha = {}", alpha);
    return Scheme::hht(alpha);
  }
  refuse("alpha");
  description = "Newmark (trapezoidal rule)";
  return Scheme::newmark();
}

/// `step` alone: fixed steps. With `tolerance`: adaptive ones, of which `step` is the first.
StepOptions read_stepping(const YamlValue& entry, double duration) {
  StepOptions options;
  if (entry.has("tolerance")) {
    options.tolerance = entry.at("tolerance").positive_number();
    if (options.tolerance >= 1)
      entry.at("tolerance").fail("expected less than 1: it is relative to the mechanism's size");
    options.size = entry.has("step") ? entry.at("step").positive_number() : 1e-4 * duration;
    if (entry.has("largest_step")) options.largest = entry.at("largest_step").positive_number();
    if (options.size > options.largest)
      entry.at("step").fail(
          fmt::format("{:.6g} s is longer than the largest step, {:.6g} s", options.size, options.largest));
  } else {
    options.size = entry.at("step").positive_number();
    if (entry.has("largest_step")) entry.at("largest_step").fail("is for adaptive steps: give a `tolerance` as well");
  }
  if (options.size > duration)
    entry.at("step").fail(fmt::format("{:.6g} s is longer than the duration, {:.6g} s", options.size, duration));
  return options;
}

/// `newton: {tolerance, iterations, line_search, tangent}`.
NewtonOptions read_newton(const YamlValue& analysis, bool dynamic) {
  NewtonOptions options;
  const auto entry = analysis.find("newton");
  if (!entry) return options;
  std::vector<std::string> keys = {"tolerance", "iterations", "line_search"};
  if (dynamic) keys.emplace_back("tangent");
  entry->check_keys(keys, "`newton`");
  if (entry->has("tolerance")) options.tolerance = entry->at("tolerance").positive_number();
  if (options.tolerance > 1e-3)
    entry->at("tolerance").fail("expected at most 1e-3: it is relative to the largest forces");
  if (entry->has("iterations")) options.iterations = entry->at("iterations").integer();
  if (options.iterations < 2) entry->at("iterations").fail("expected at least 2");
  if (entry->has("line_search")) options.line_search = entry->at("line_search").boolean();
  if (entry->has("tangent"))
    options.reuse_tangent = entry->at("tangent").word({"reused", "renewed"}, "a way with the tangent") == "reused";
  return options;
}

/// `until: {load_factor: s}` or `{node: tip, displacement: d, direction: x}`.
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
  end.node = model.node_named_by(entry.at("node"));
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

/// `arc_length: {until: {..}, points: 1000}`.
PathOptions read_path(const YamlValue& entry, int steps, const Model& model) {
  entry.check_keys({"until", "points"}, "`arc_length`");
  PathOptions path;
  path.end = read_path_end(entry.at("until"), model);
  path.steps = steps;
  if (entry.has("points")) path.most_points = entry.at("points").integer();
  if (path.most_points < 1) entry.at("points").fail("expected at least 1");
  return path;
}

void read_static(const YamlValue& entry, const Model& model, Analysis& analysis) {
  entry.check_keys({"type", "steps", "arc_length", "newton"}, "the analysis 'static'");
  analysis.type = Analysis::Type::statics;
  const auto path = entry.find("arc_length");
  if (path) analysis.steps = 0;
  if (const auto steps = entry.find("steps")) {
    const bool automatic = steps->is_scalar() && steps->text() == "auto";
    analysis.steps = automatic ? 0 : steps->integer();
    if (!automatic && analysis.steps < 1) steps->fail("expected at least one load step, or auto");
  }
  if (path) analysis.path = read_path(*path, analysis.steps, model);
  analysis.newton = read_newton(entry, false);
}

}  // namespace

Analysis read_analysis(const YamlValue& entry, const Model& model) {
  const std::vector<std::string> planned = {"kinematic", "eigen", "inverse_dynamics", "frequency_response",
                                            "state_space"};
  const std::string type = entry.at("type").text();
  if (std::find(planned.begin(), planned.end(), type) != planned.end())
    entry.at("type").fail(
        fmt::format("the analysis '{}' is not in this version; there are assembly, static and dynamic", type));
  Analysis analysis;
  analysis.name = entry.at("type").word({"assembly", "static", "dynamic"}, "a type of analysis");
  if (analysis.name == "assembly") {
    entry.check_keys({"type"}, "the analysis 'assembly'");
    analysis.type = Analysis::Type::assembly;
  } else if (analysis.name == "static") {
    read_static(entry, model, analysis);
  } else {
    entry.check_keys({"type", "duration", "step", "tolerance", "largest_step", "scheme", "rho", "alpha", "constraints",
                      "start", "newton"},
                     "the analysis 'dynamic'");
    analysis.type = Analysis::Type::dynamics;
    analysis.duration = entry.at("duration").positive_number();
    analysis.stepping = read_stepping(entry, analysis.duration);
    analysis.scheme = read_scheme(entry, analysis.scheme_name);
    analysis.newton = read_newton(entry, true);
    analysis.equilibrium =
        entry.has("start") && entry.at("start").word({"as_given", "equilibrium"}, "a start") == "equilibrium";
    if (entry.has("constraints")) {
      const std::string form =
          entry.at("constraints").word({"corrected", "position", "stabilized"}, "a form of constraints");
      if (form == "position") {
        analysis.form = ConstraintForm::position;
        analysis.scheme_name += ", constraints of positions alone";
      } else if (form == "stabilized") {
        analysis.form = ConstraintForm::stabilised;
        analysis.scheme_name += ", stabilised constraints";
      }
    }
  }
  return analysis;
}

}  // namespace bielle::mechanism
