#include "mechanism/io/mechanism_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/elements/forces/support.hpp"
#include "mechanism/elements/superelement/body_points.hpp"
#include "mechanism/hydraulics/reading/circuit_reader.hpp"
#include "mechanism/io/component_table.hpp"
#include "mechanism/io/implausible_lengths.hpp"
#include "mechanism/measures/input_measure.hpp"
#include "mechanism/measures/measure_event.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_file.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

constexpr const char* direction_names[] = {"x", "y", "z", "rx", "ry", "rz"};
const std::vector<std::string> directions(std::begin(direction_names), std::end(direction_names));

constexpr PlausibleRange plausible_gravity{0, 300, "Lengths are in metres: on the earth 9.81 m/s^2"};

std::size_t direction_index(const std::string& name) {
  return static_cast<std::size_t>(std::find(directions.begin(), directions.end(), name) - directions.begin());
}

/// Evaluates the parameters; each may use those written before it.
void read_parameters(YamlValue& root, const std::map<std::string, std::string>& overrides) {
  std::vector<std::string> names;
  if (const auto section = root.find("parameters"))
    for (const auto& [name, value] : section->entries()) {
      const auto given = overrides.find(name);
      try {
        root.set_parameter(
            name, given == overrides.end() ? value.number() : Expression(given->second, {}, root.parameters())({}));
      } catch (const std::runtime_error& error) {
        if (given == overrides.end()) throw;
        throw InputError(fmt::format("--set {}={}: {}", name, given->second, error.what()));
      }
      names.push_back(name);
    }
  for (const auto& [name, expression] : overrides)
    if (!root.parameters().count(name))
      throw InputError(fmt::format("--set {}={}: {} has no parameter '{}'{}", name, expression, root.file(), name,
                                   did_you_mean(name, names)));
}

/// Checks that an item of a list occurs only once. @param seen  names so far
void check_once(const YamlValue& item, const std::string& name, std::set<std::string>& seen) {
  if (!seen.insert(name).second) item.fail(fmt::format("'{}' stands in this list twice", name));
}

/// Reads a formula of t, or `{table: f.csv}`.
Expression read_acceleration(const YamlValue& value) {
  if (!value.is_map()) return value.expression();
  return read_named_file(value.at("table"), [](const std::string& path) {
    return Expression(fmt::format("table('{}', t)", std::filesystem::absolute(path).string()), {"t"});
  });
}

const KeyTable& acceleration_keys() {
  using namespace keys;
  static const KeyTable table{"an acceleration",
                              "An acceleration that was measured.",
                              {{"table", file("table of times and values"), required, "Times [s] and values."}}};
  return table;
}

const KeyTable& motion_by_acceleration_keys() {
  using namespace keys;
  static const KeyTable table{
      "a motion by its acceleration",
      "A motion whose acceleration is known, which the program integrates.",
      {{"acceleration", {formula("m/s^2 or rad/s^2", {"t"}), nested(acceleration_keys)}, required, "The acceleration."},
       {"velocity", number("m/s or rad/s"), otherwise("0"), "Velocity at the start."},
       {"displacement", number("m or rad"), otherwise("0"), "Displacement at the start."}}};
  return table;
}

const KeyTable& motion_keys() {
  using namespace keys;
  const auto along = [](const char* name, const char* unit, const char* about) {
    return Key{name, {formula(unit, {"t"}), nested(motion_by_acceleration_keys)}, optional, about};
  };
  static const KeyTable table{"`motion`",
                              "Prescribed motion of a node. Rotations are prescribed all three together.",
                              {along("x", "m", "Displacement along the inertial x axis."),
                               along("y", "m", "Displacement along the inertial y axis."),
                               along("z", "m", "Displacement along the inertial z axis."),
                               along("rx", "rad", "Component x of the rotation vector."),
                               along("ry", "rad", "Component y of the rotation vector."),
                               along("rz", "rad", "Component z of the rotation vector.")}};
  return table;
}

PrescribedMotion read_motion(const YamlValue& value) {
  if (!value.is_map()) {
    const Expression displacement = value.expression();
    warn_of_jumps(value, displacement, "the prescribed motion");
    return displacement;
  }
  return PrescribedMotion::of_acceleration(read_acceleration(value.at("acceleration")), value.at("velocity").number(),
                                           value.at("displacement").number());
}

void read_holds(const YamlValue& entry, Node& node) {
  if (const auto fixed = entry.find("fixed")) {
    if (fixed->is_sequence()) {
      std::set<std::string> seen;
      for (const YamlValue& item : fixed->items()) {
        const std::string direction = item.word();
        check_once(item, direction, seen);
        node.freedom[direction_index(direction)] = Freedom::fixed;
      }
    } else if (fixed->boolean()) {
      node.freedom.fill(Freedom::fixed);
    }
  }
  if (const auto motion = entry.find("motion")) {
    for (const auto& [name, value] : motion->entries()) {
      const std::size_t k = direction_index(name);
      if (node.freedom[k] == Freedom::fixed && entry.at("fixed").is_sequence())
        value.fail("this direction is fixed as well");
      node.freedom[k] = Freedom::prescribed;
      node.motion[k] = read_motion(value);
    }
    // Rotations are prescribed together: fixed ones stay zero.
    const auto rotations = node.freedom.begin() + 3;
    if (std::count(rotations, node.freedom.end(), Freedom::prescribed) > 0 &&
        std::count(rotations, node.freedom.end(), Freedom::free) > 0)
      motion->fail("prescribed rotations come all three together: give rx, ry and rz, or fix the others");
  }
}

/// Checks that all, two or none of the rotations of a node are held.
void check_holds(const YamlValue& entry, const Node& node) {
  const auto rotations = node.freedom.begin() + 3;
  if (std::count(rotations, node.freedom.end(), Freedom::fixed) == 1 &&
      std::count(rotations, node.freedom.end(), Freedom::free) == 2)
    entry.at("fixed").fail(
        "all three rotations of a node can be held, or two, or none, but not one alone; a universal joint holds one");
}

/// A held direction has no velocity of its own: a given one is an error, and must not be ignored.
void check_velocities(const YamlValue& entry, const Node& node) {
  for (std::size_t k = 0; k < 3; ++k)
    if (node.velocity[static_cast<int>(k)] != 0 && node.freedom[k] != Freedom::free)
      entry.at("velocity").fail(fmt::format("the node is held along {}", directions[k]));
  const Vector3 omega = node.frame.R * node.angular_velocity;
  for (std::size_t k = 0; k < 3; ++k)
    if (node.freedom[3 + k] != Freedom::free && std::abs(omega[static_cast<int>(k)]) > 1e-12 * omega.norm())
      entry.at("angular_velocity").fail(fmt::format("the node is held against turning about {}", "xyz"[k]));
}

const KeyTable& node_keys() {
  using namespace keys;
  static const KeyTable table{
      "a node", "A point with axes, which move.",
      joined({frame_keys(),
              {{"velocity", vector3("m/s"), otherwise("[0, 0, 0]"), "Velocity at the start, in inertial components."},
               {"angular_velocity", vector3("rad/s"), otherwise("[0, 0, 0]"),
                "Angular velocity at the start, in the node's own axes."},
               {"fixed",
                {boolean(), list_of(word(directions, "a direction"))},
                otherwise("false"),
                "Held directions, `true` for all six: displacements x, y, z and rotations rx, ry, rz."},
               {"motion", nested(motion_keys), optional,
                "Prescribed displacements from the place, each as a formula of t or by its acceleration."}}})};
  return table;
}

void read_node(const std::string& name, const YamlValue& given, Model& model) {
  const YamlValue entry = given.keyed(node_keys());
  if (name == "ground") entry.fail("'ground' is the built-in fixed node at the origin; choose another name");
  Node node;
  node.name = name;
  node.frame = read_frame(entry);
  node.velocity = entry.at("velocity").vector3();
  node.angular_velocity = entry.at("angular_velocity").vector3();
  read_holds(entry, node);
  check_holds(entry, node);
  check_velocities(entry, node);
  model.add_node(std::move(node));
}

/// Returns the entries of a section, with names under which results can be stored.
std::vector<std::pair<std::string, YamlValue>> named_entries(const YamlValue& section) {
  auto entries = section.entries();
  for (const auto& [name, entry] : entries) check_name(name, entry);
  return entries;
}

MechanismFile read_mechanism(YamlValue root, const std::map<std::string, std::string>& overrides) {
  root.check_keys({"mechanism", "gravity", "parameters", "nodes", "elements", "joints", "drives", "loads", "states",
                   "measures", "inputs", "events", "analysis", "output", "points", "hydraulics"},
                  "a mechanism file");
  MechanismFile file;
  file.text = root.source_text();
  read_parameters(root, overrides);
  file.maker = [text = file.text, name = root.file(), overrides](const std::string& parameter, double value) {
    std::map<std::string, std::string> others = overrides;
    others[parameter] = fmt::format("{}", value);
    return read_mechanism_text(text, name, others).model;
  };
  file.model.parameters = root.parameters();
  if (root.has("mechanism")) file.model.title = root.at("mechanism").text();
  if (const auto gravity = root.find("gravity")) {
    file.model.environment.gravity = gravity->vector3();
    constexpr double most = 1e60;  // largest gravity with finite weights
    if (!(file.model.environment.gravity.cwiseAbs().maxCoeff() < most))
      gravity->fail("expected accelerations in m/s^2; no force can be computed with these");
    warn_outside(*gravity, file.model.environment.gravity.norm(), plausible_gravity);
  }

  if (root.has("nodes"))
    for (const auto& [name, entry] : named_entries(root.at("nodes"))) read_node(name, entry, file.model);
  if (const auto points = root.find("points")) read_body_points(*points, root.find("elements"), file.model);
  if (const auto hydraulics = root.find("hydraulics")) read_hydraulics(*hydraulics, file.model);
  for (const Section section : {Section::elements, Section::joints, Section::drives, Section::loads, Section::states}) {
    const auto entries = root.find(section_name(section));
    if (!entries) continue;
    for (const auto& [name, entry] : named_entries(*entries)) read_component(section, name, entry, file.model);
  }
  if (const auto measures = root.find("measures"))
    for (const auto& [name, entry] : named_entries(*measures)) read_measure(name, entry, file.model);
  if (const auto inputs = root.find("inputs"))
    for (const auto& [name, entry] : named_entries(*inputs)) read_input(name, entry, file.model);
  if (const auto events = root.find("events"))
    for (const auto& [name, entry] : named_entries(*events)) read_event(name, entry, file.model);
  file.model.connect();
  add_supports(file.model);
  warn_of_lengths(file.model, root);
  if (file.model.members().empty()) root.fail("the mechanism has no elements, joints or loads");

  if (const auto analyses = root.find("analysis"))
    for (const YamlValue& entry : analyses->items()) file.analyses.push_back(read_analysis(entry, file.model));
  for (const auto& analysis : file.analyses) analysis->set_maker(file.maker);
  double end = 0;
  bool statics = false;
  for (const auto& analysis : file.analyses) {
    end += analysis->duration();
    statics = statics || analysis->type() == "static";
  }
  if (const auto output = root.find("output")) file.output = read_output(*output, end, statics, file.model);
  file.warnings = root.warnings();
  file.model.source = root.digest({"mechanism", "parameters", "analysis", "output"});
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
