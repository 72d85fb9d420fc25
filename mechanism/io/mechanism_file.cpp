#include "mechanism/io/mechanism_file.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "mechanism/io/component_table.hpp"
#include "mechanism/system/read_frame.hpp"

namespace bielle::mechanism {
namespace {

constexpr const char* direction_names[] = {"x", "y", "z", "rx", "ry", "rz"};
const std::vector<std::string> directions(std::begin(direction_names), std::end(direction_names));

std::size_t direction_index(const std::string& name) {
  return static_cast<std::size_t>(std::find(directions.begin(), directions.end(), name) - directions.begin());
}

/// Evaluates the parameters; each may use those written before it.
Parameters read_parameters(YamlValue& root, const std::map<std::string, std::string>& overrides) {
  Parameters parameters;
  std::vector<std::string> names;
  if (const auto section = root.find("parameters"))
    for (const auto& [name, value] : section->entries()) {
      const auto given = overrides.find(name);
      try {
        parameters[name] = given == overrides.end() ? value.number() : Expression(given->second, {}, parameters)({});
      } catch (const std::runtime_error& error) {
        if (given == overrides.end()) throw;
        throw InputError(fmt::format("--set {}={}: {}", name, given->second, error.what()));
      }
      names.push_back(name);
      root.set_parameters(parameters);
    }
  for (const auto& [name, expression] : overrides)
    if (!parameters.count(name))
      throw InputError(fmt::format("--set {}={}: {} has no parameter '{}'{}", name, expression, root.file(), name,
                                   did_you_mean(name, names)));
  return parameters;
}

void read_holds(const YamlValue& entry, Node& node) {
  if (const auto fixed = entry.find("fixed")) {
    if (fixed->is_sequence()) {
      for (const YamlValue& item : fixed->items())
        node.freedom[direction_index(item.word(directions, "a direction"))] = Freedom::fixed;
    } else if (fixed->boolean()) {
      node.freedom.fill(Freedom::fixed);
    }
  }
  if (const auto motion = entry.find("motion")) {
    motion->check_keys(directions, "`motion`");
    for (const auto& [name, value] : motion->entries()) {
      const std::size_t k = direction_index(name);
      if (node.freedom[k] == Freedom::fixed && entry.at("fixed").is_sequence())
        value.fail("this direction is fixed as well");
      node.freedom[k] = Freedom::prescribed;
      node.motion[k] = value.expression({"t"});
    }
    // Rotations are prescribed together: those that are fixed stay zero.
    const auto rotations = node.freedom.begin() + 3;
    const auto prescribed = std::count(rotations, node.freedom.end(), Freedom::prescribed);
    if (prescribed > 0) {
      if (std::count(rotations, node.freedom.end(), Freedom::free) > 0)
        motion->fail("prescribed rotations come all three together: give rx, ry and rz, or fix the others");
      std::fill(rotations, node.freedom.end(), Freedom::prescribed);
    }
  }
}

/// The rotations of a node can be held all, or two, or none.
void check_holds(const YamlValue& entry, const Node& node) {
  const auto rotations = node.freedom.begin() + 3;
  if (std::count(rotations, node.freedom.end(), Freedom::fixed) == 1 &&
      std::count(rotations, node.freedom.end(), Freedom::free) == 2)
    entry.at("fixed").fail(
        "all three rotations of a node can be held, or two, or none, but not one alone; a universal joint holds one");
}

/// What is held has no velocity of its own: to give one is a mistake, not to be forgotten.
void check_velocities(const YamlValue& entry, const Node& node) {
  for (std::size_t k = 0; k < 3; ++k)
    if (node.velocity[static_cast<int>(k)] != 0 && node.freedom[k] != Freedom::free)
      entry.at("velocity").fail(fmt::format("the node is held along {}", directions[k]));
  const Vector3 omega = node.frame.R * node.angular_velocity;
  for (std::size_t k = 0; k < 3; ++k)
    if (node.freedom[3 + k] != Freedom::free && std::abs(omega[static_cast<int>(k)]) > 1e-12 * omega.norm())
      entry.at("angular_velocity").fail(fmt::format("the node is held against turning about {}", "xyz"[k]));
}

void read_node(const std::string& name, const YamlValue& entry, Model& model) {
  std::vector<std::string> keys = {"position", "velocity", "angular_velocity", "fixed", "motion"};
  keys.insert(keys.end(), orientation_keys().begin(), orientation_keys().end());
  entry.check_keys(keys, "a node");
  if (name == "ground") entry.fail("'ground' is the built-in fixed node at the origin; choose another name");
  Node node;
  node.name = name;
  node.frame = read_frame(entry);
  if (entry.has("velocity")) node.velocity = entry.at("velocity").vector3();
  if (entry.has("angular_velocity")) node.angular_velocity = entry.at("angular_velocity").vector3();
  read_holds(entry, node);
  check_holds(entry, node);
  check_velocities(entry, node);
  model.add_node(std::move(node));
}

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
    end.direction = direction->is_sequence() ? Vector3(direction->direction())
                                             : Vector3::Unit(static_cast<Eigen::Index>(direction_index(direction->word(
                                                   {"x", "y", "z"}, "a direction (x, y, z or a vector)"))));
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

/// `only: {nodes: [pin], joints: []}`: of the sections that are named, nothing else is recorded.
void read_only(const YamlValue& only, Model& model) {
  const std::vector<std::string> sections = {"nodes", "joints", "elements"};
  only.check_keys(sections, "`only`");
  for (const auto& [section, list] : only.entries()) {
    std::vector<std::string> available;
    if (section == "nodes") {
      for (const Node& node : model.nodes())
        if (!node.internal && node.name != "ground") available.push_back(node.name);
    } else {
      available = model.names_in(section);
    }
    std::set<std::string> wanted;
    for (const YamlValue& item : list.items())
      if (!wanted.insert(item.word(available, "one of the " + section)).second) item.fail("is named twice");
    for (const std::string& name : available)
      if (!wanted.contains(name)) model.leave_out(section + "/" + name);
  }
}

/// `fields: {rod: [displacement, von_mises]}`: what elements record beside their own outputs.
void read_fields(const YamlValue& fields, Model& model) {
  fields.check_keys(model.names_in("elements"), "`fields`, which names elements");
  for (const auto& [element, names] : fields.entries()) {
    if (!model.records("elements/" + element)) names.fail(fmt::format("`only` leaves out '{}'", element));
    Component& component = *model.components_in("elements/" + element).front();
    const std::vector<std::string> available = component.optional_fields();
    if (available.empty())
      names.fail(fmt::format("a {} has no further fields: all that it knows is recorded already", component.type()));
    for (const YamlValue& name : names.items()) {
      const std::string field = name.word(available, "a field of '" + element + "'");
      for (const OutputField& recorded : component.output_fields())
        if (recorded.name == field) name.fail("is asked for twice");
      try {
        component.record_field(field);
      } catch (const InputError& error) {
        name.fail(error.what());
      }
    }
  }
}

/// Times to record, ascending. @param end  of the last dynamic analysis [s]
std::vector<double> read_times(const YamlValue& entry, double end) {
  std::vector<double> times;
  for (const YamlValue& item : entry.items()) {
    const double time = item.number();
    if (!(time >= 0 && time <= end * (1 + 1e-12)))
      item.fail(fmt::format("the dynamic analyses run from t = 0 to {:.6g} s", end));
    if (!times.empty() && time <= times.back()) item.fail("expected times in ascending order, each once");
    times.push_back(time);
  }
  if (times.empty()) entry.fail("expected a list of times [s]");
  return times;
}

OutputOptions read_output(const YamlValue& entry, double end, Model& model) {
  entry.check_keys({"every", "times", "only", "fields", "checkpoint", "log"}, "`output`");
  OutputOptions output;
  if (entry.has("times")) {
    if (entry.has("every")) entry.at("every").fail("either `every` or `times`, not both");
    output.times = read_times(entry.at("times"), end);
  }
  if (entry.has("every")) output.every = entry.at("every").integer();
  if (output.every < 1) entry.at("every").fail("expected at least 1");
  if (entry.has("checkpoint")) {
    output.checkpoint = entry.at("checkpoint").integer();
    if (output.checkpoint < 1) entry.at("checkpoint").fail("expected at least 1 step");
  }
  if (entry.has("log")) output.log = entry.at("log").boolean();
  if (const auto only = entry.find("only")) read_only(*only, model);
  if (const auto fields = entry.find("fields")) read_fields(*fields, model);
  return output;
}

MechanismFile read_mechanism(YamlValue root, const std::map<std::string, std::string>& overrides) {
  root.check_keys(
      {"mechanism", "gravity", "parameters", "nodes", "elements", "joints", "drives", "loads", "analysis", "output"},
      "a mechanism file");
  MechanismFile file;
  file.text = root.source_text();
  file.model.parameters = read_parameters(root, overrides);
  root.set_parameters(file.model.parameters);
  if (root.has("mechanism")) file.model.title = root.at("mechanism").text();
  if (root.has("gravity")) file.model.environment.gravity = root.at("gravity").vector3();

  if (root.has("nodes"))
    for (const auto& [name, entry] : root.at("nodes").entries()) read_node(name, entry, file.model);
  for (const Section section : {Section::elements, Section::joints, Section::drives, Section::loads}) {
    const auto entries = root.find(section_name(section));
    if (!entries) continue;
    for (const auto& [name, entry] : entries->entries()) read_component(section, name, entry, file.model);
  }
  if (file.model.members().empty()) root.fail("the mechanism has no elements, joints or loads");

  if (const auto analyses = root.find("analysis"))
    for (const YamlValue& entry : analyses->items()) file.analyses.push_back(read_analysis(entry, file.model));
  double end = 0;
  for (const Analysis& analysis : file.analyses) end += analysis.duration;
  if (const auto output = root.find("output")) file.output = read_output(*output, end, file.model);
  return file;
}

}  // namespace

MechanismFile read_mechanism_file(const std::string& path, const std::map<std::string, std::string>& overrides) {
  MechanismFile file = read_mechanism(YamlValue::load(path), overrides);
  file.path = path;
  return file;
}

MechanismFile read_mechanism_text(const std::string& text, const std::string& name,
                                  const std::map<std::string, std::string>& overrides) {
  return read_mechanism(YamlValue::parse(text, name), overrides);
}

}  // namespace bielle::mechanism
