#include "mechanism/io/node_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/drawing/reading/shape_reader.hpp"
#include "mechanism/elements/forces/held_directions.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_file.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "reduce/common/direction_words.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

const std::vector<std::string> directions(direction_words.begin(), direction_words.end());

std::size_t direction_index(const std::string& name) {
  return static_cast<std::size_t>(std::find(directions.begin(), directions.end(), name) - directions.begin());
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
  static const KeyTable table{
      "`motion`",
      "Prescribed motion of a node, from its place at the start. Rotations are prescribed all three together: "
      "components of a rotation vector about inertial axes, which turns the start orientation.",
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

/// The directions in which a node is held, along the columns of `axes`, which are inertial components.
struct Holds {
  std::array<bool, 6> fixed{};
  Matrix3 axes = Matrix3::Identity();
  bool own_axes = false;
};

Holds read_fixed(const YamlValue& entry, const Frame& frame) {
  Holds holds;
  const auto fixed = entry.find("fixed");
  if (fixed && fixed->is_sequence()) {
    std::set<std::string> seen;
    for (const YamlValue& item : fixed->items()) {
      const std::string direction = item.word();
      check_once(item, direction, seen);
      holds.fixed[direction_index(direction)] = true;
    }
  } else if (fixed && fixed->boolean()) {
    holds.fixed.fill(true);
  }
  if (const auto axes = entry.find("fixed_axes")) {
    if (!fixed || !fixed->is_sequence()) axes->fail("belongs to a list of `fixed` directions");
    holds.own_axes = axes->word() == "own";
    if (holds.own_axes) holds.axes = frame.R;
  }
  return holds;
}

/// Returns the directions that are held by a constraint instead of being removed: a single rotation; and, along axes
/// other than the inertial ones, one or two displacements, or two rotations.
std::array<bool, 6> constrained(const Holds& holds) {
  std::array<bool, 6> result{};
  for (const std::ptrdiff_t first : {0, 3}) {
    const auto begin = holds.fixed.begin() + first;
    const auto count = std::count(begin, begin + 3, true);
    if (count == 3 || (!holds.own_axes && !(first == 3 && count == 1))) continue;
    std::copy(begin, begin + 3, result.begin() + first);
  }
  return result;
}

void read_holds(const YamlValue& entry, const Holds& holds, Node& node) {
  for (std::size_t k = 0; k < 6; ++k)
    if (holds.fixed[k]) node.freedom[k] = Freedom::fixed;
  if (const auto motion = entry.find("motion")) {
    if (holds.own_axes)
      motion->fail(
          "a motion is along inertial axes, and the node is fixed along its own: move it by a joint and a drive");
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

/// Refuses a velocity that is given along a held direction, which has none of its own.
void check_velocities(const YamlValue& entry, const Holds& holds, const Node& node) {
  const Vector3 v = holds.axes.transpose() * node.velocity;
  const double rounding = holds.own_axes ? 1e-12 * v.norm() : 0;
  const char* axes = holds.own_axes ? " of its own axes" : "";
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(v[static_cast<int>(k)]) > rounding && node.freedom[k] != Freedom::free)
      entry.at("velocity").fail(fmt::format("the node is held along {}{}", directions[k], axes));
  const Vector3 omega = holds.axes.transpose() * (node.frame.R * node.angular_velocity);
  for (std::size_t k = 0; k < 3; ++k)
    if (node.freedom[3 + k] != Freedom::free && std::abs(omega[static_cast<int>(k)]) > 1e-12 * omega.norm())
      entry.at("angular_velocity").fail(fmt::format("the node is held against turning about {}{}", "xyz"[k], axes));
}

/// Adds the constraints of a node. @param held  directions that they hold
void add_constraints(const YamlValue& entry, const Holds& holds, const std::array<bool, 6>& held, int index,
                     Model& model) {
  const Node& node = model.node(index);
  model.add(std::make_unique<HeldDirections>(node, index, holds.axes, held), Entry{Section::supports, node.name},
            Recorded::no);
  model.when_read(Model::Stage::connections, [entry, index, &model] {
    if (const auto& carrier = model.node(index).carrier)
      entry.at("fixed").fail(
          fmt::format("the node is carried rigidly by '{}' and cannot be fixed as well", model.node(*carrier).name));
  });
}

/// The entries of the section, which may be placed relative to each other.
class NodeReader {
 public:
  explicit NodeReader(const std::vector<std::pair<std::string, YamlValue>>& entries) {
    for (const auto& [name, entry] : entries) {
      if (name == "ground") entry.fail("'ground' is the built-in fixed node at the origin; choose another name");
      entries_.emplace(name, entry.keyed(node_keys()));
    }
  }

  Frame frame(const std::string& name) {
    // A loop is used instead of a recursion, because any number of nodes may be placed relative to each other.
    std::vector<std::string> open = {name};  // nodes whose place is sought, each relative to the next one
    std::set<std::string> names = {name};
    Frame frame;
    while (!frames_.count(open.back())) {
      const auto at = entries_.at(open.back()).find("at");
      if (!at || at->text() == "ground") break;
      const std::string base = base_name(*at);
      open.push_back(base);
      if (!names.insert(base).second)
        at->fail(fmt::format("nodes are placed relative to each other in a circle: {}", fmt::join(open, ", ")));
    }
    for (auto each = open.rbegin(); each != open.rend(); ++each) {
      const auto known = frames_.find(*each);
      frame = known != frames_.end() ? known->second : frame * read_frame(entries_.at(*each));
      frames_.emplace(*each, frame);
    }
    return frame;
  }

  const YamlValue& entry(const std::string& name) const { return entries_.at(name); }

 private:
  std::string base_name(const YamlValue& at) const {
    const std::string base = at.text();
    if (!entries_.count(base)) {
      std::vector<std::string> names;
      for (const auto& [known, entry] : entries_) names.push_back(known);
      at.fail(fmt::format("there is no node '{}'{}", base, did_you_mean(base, names)));
    }
    return base;
  }

  std::map<std::string, YamlValue> entries_;
  std::map<std::string, Frame> frames_;
};

void read_node(const std::string& name, const YamlValue& entry, const Frame& frame, Model& model) {
  Node node;
  node.name = name;
  node.frame = frame;
  node.velocity = entry.at("velocity").vector3();
  node.angular_velocity = entry.at("angular_velocity").vector3();
  const Holds holds = read_fixed(entry, frame);
  read_holds(entry, holds, node);
  check_velocities(entry, holds, node);
  std::array<bool, 6> by_constraint = constrained(holds);
  // Prescribed rotations are prescribed all three together.
  if (std::find(node.freedom.begin() + 3, node.freedom.end(), Freedom::prescribed) != node.freedom.end())
    std::fill(by_constraint.begin() + 3, by_constraint.end(), false);
  for (std::size_t k = 0; k < 6; ++k)
    if (by_constraint[k]) node.freedom[k] = Freedom::free;
  const int index = model.add_node(std::move(node));
  if (std::find(by_constraint.begin(), by_constraint.end(), true) != by_constraint.end())
    add_constraints(entry, holds, by_constraint, index, model);
  if (const auto shape = entry.find("shape")) read_shapes(*shape, {Section::nodes, name}, index, model);
}

}  // namespace

const KeyTable& node_keys() {
  using namespace keys;
  static const KeyTable table{
      "a node", "A point with axes, which move.",
      joined(
          {{{"position", vector3("m").as_point().in_inertial_axes(), otherwise("[0, 0, 0]"),
             "Position of the origin: inertial, or in the axes of the node `at`."}},
           inertial_orientation_keys(),
           {{"at", name_of("node"), computed("the inertial axes"),
             "Node in whose axes the position and the orientation are given."},
            {"carried_by", name_of("element"), optional,
             "Rigid body that carries the node, as one of those that it names `also`."},
            {"velocity", vector3("m/s").as_vector().in_inertial_axes(), otherwise("[0, 0, 0]"),
             "Velocity at the start, in inertial components, along free directions."},
            {"angular_velocity", vector3("rad/s").as_axial(), otherwise("[0, 0, 0]"),
             "Angular velocity at the start, in the node's own axes, about free directions."},
            {"fixed",
             {boolean(), number(), list_of(word(directions, "a direction"))},
             otherwise("false"),
             "Held directions: `true`, or a number or formula of parameters that is not zero, for all six; or a "
             "list of displacements x, y, z and rotations rx, ry, rz, along and about the axes `fixed_axes`."},
            {"fixed_axes", word({"inertial", "own"}, "the axes"), otherwise("inertial"),
             "Axes of the directions that `fixed` lists: the inertial ones, or the node's own as drawn. They stay in "
             "space."},
            {"motion", nested(motion_keys), optional,
             "Prescribed motion from the start, each direction as a formula of t or by its acceleration."},
            shape_key()}})};
  return table;
}

void read_nodes(const std::vector<std::pair<std::string, YamlValue>>& entries, Model& model) {
  NodeReader reader(entries);
  for (const auto& [name, entry] : entries) read_node(name, reader.entry(name), reader.frame(name), model);
}

}  // namespace bielle::mechanism
