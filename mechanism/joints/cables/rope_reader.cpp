// Readers of `belt` and `cable`.
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/joints/cables/rope_grip.hpp"
#include "mechanism/joints/counted_from_drawing.hpp"
#include "mechanism/math/axes_along.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {
namespace {

/// Reads one point for each node, in the node's axes; `~`: the node itself.
std::vector<Vector3> read_places(const YamlValue& entry, std::size_t count) {
  std::vector<Vector3> places(count, Vector3::Zero());
  const auto at = entry.find("at");
  if (!at) return places;
  if (!at->is_sequence() || at->size() != count)
    at->fail(fmt::format("expected {} points, one in the axes of each node (`~`: the node itself)", count));
  for (std::size_t k = 0; k < count; ++k)
    if (!at->at(k).is_null()) places[k] = at->at(k).vector3();
  return places;
}

/// Reads the number of additional turns of the rope on each place; `~`: none.
std::vector<int> read_turns(const YamlValue& entry, std::size_t count) {
  std::vector<int> turns(count, 0);
  const auto given = entry.find("turns");
  if (!given) return turns;
  if (!given->is_sequence() || given->size() != count)
    given->fail(fmt::format("expected {} numbers of turns, one for each node (`~`: none more than drawn)", count));
  for (std::size_t k = 0; k < count; ++k) {
    if (given->at(k).is_null()) continue;
    turns[k] = given->at(k).integer();
  }
  return turns;
}

RopePath read_path(const YamlValue& entry, const Model& model) {
  const YamlValue names = entry.at("nodes");
  if (!names.is_sequence() || names.size() < 2)
    names.fail("expected two or more nodes, in the order in which the rope passes");
  const std::size_t count = names.size();
  RopePath path;
  const Eigen::VectorXd radii = entry.at("radii").vector();
  if (static_cast<std::size_t>(radii.size()) != count)
    entry.at("radii").fail(
        fmt::format("expected {} radii, one for each node (0: a point); a pulley that the rope turns "
                    "backwards about `axis` has a negative one",
                    count));
  const bool turns = (radii.array() != 0).any();
  const Vector3 axis = turns || entry.has("axis") ? Vector3(entry.at("axis").direction()) : Vector3::UnitZ();
  const std::vector<Vector3> places = read_places(entry, count);
  const Matrix3 axes = axes_along(axis);
  for (std::size_t k = 0; k < count; ++k) {
    const int node = node_named_by(names.at(k), model);
    if (k > 0 && node == path.nodes.back()) names.at(k).fail("follows itself: a span has two different nodes");
    const Frame& frame = model.node(node).frame;
    path.nodes.push_back(node);
    path.names.push_back(model.node(node).name);
    path.drawn.push_back(frame);
    Pulley pulley;
    pulley.on_node.x = places[k];
    pulley.on_node.R = frame.R.transpose() * axes;
    pulley.radius = radii[static_cast<Eigen::Index>(k)];
    path.pulleys.push_back(pulley);
  }
  path.turns = read_turns(entry, count);
  return path;
}

std::vector<int> nodes_with_pulleys(const RopePath& path) {
  std::vector<int> nodes;
  for (std::size_t k = 0; k < path.nodes.size(); ++k)
    if (path.pulleys[k].radius != 0 && path.nodes[k] != 0) nodes.push_back(path.nodes[k]);
  return nodes;
}

RopeMaterial read_material(const YamlValue& entry) {
  RopeMaterial material{entry.at("EA").number()};
  material.damping = entry.at("damping").number();
  material.pretension = entry.at("pretension").number();
  return material;
}

/// Adds the section from one place of the path to another.
const RopeSection& add_section(const char* type, const std::string& name, const RopePath& path,
                               const std::vector<std::size_t>& places, const RopeMaterial& material,
                               const YamlValue& entry, Recorded recorded, Model& model) {
  RopePath part;
  for (const std::size_t k : places) {
    part.nodes.push_back(path.nodes[k]);
    part.names.push_back(path.names[k]);
    part.pulleys.push_back(path.pulleys[k]);
    part.drawn.push_back(path.drawn[k]);
    part.turns.push_back(path.turns[k]);
  }
  try {
    auto section = std::make_unique<RopeSection>(type, name, std::move(part), material);
    const RopeSection& added = *section;
    model.add(std::move(section), Entry{Section::joints, name}, recorded);
    return added;
  } catch (const std::domain_error& error) {
    entry.at("radii").fail(error.what());
  }
}

/// Adds monitors of the pulleys that the rope grips between its sections.
void add_grips(const std::string& name, const std::vector<const RopeSection*>& sections, bool closed, Model& model) {
  for (std::size_t k = closed ? 0 : 1; k < sections.size(); ++k) {
    const RopeSection &before = *sections[(k + sections.size() - 1) % sections.size()], &after = *sections[k];
    if (after.path().pulleys.front().radius != 0)
      model.add(std::make_unique<RopeGrip>(before, after), Entry{Section::joints, name}, Recorded::no);
  }
}

/// Draws the course of the rope, and its pulleys.
void add_course(const std::string& name, const RopePath& path, bool closed, Model& model) {
  const Entry entry{Section::joints, name};
  DrawnItem course{.shape = "course", .values = {{"closed", closed}}};
  for (std::size_t k = 0; k < path.nodes.size(); ++k) {
    const Pulley& pulley = path.pulleys[k];
    const double radius = std::abs(pulley.radius);
    const DrawnPlace place{path.nodes[k], pulley.on_node};
    course.places.push_back(place);
    course.pulleys.push_back({radius, pulley.radius < 0 ? -1 : 1});
    if (radius > 0) model.add_shape(entry, {.shape = "pulley", .places = {place}, .values = {{"radius", radius}}});
  }
  model.add_shape(entry, std::move(course));
}

}  // namespace

namespace {

std::vector<Key> rope_keys() {
  using namespace keys;
  return {type_key(),
          {"nodes", list_of(name_of("node")).items_at_least(2), required,
           "Nodes in the order in which the rope passes them."},
          {"radii", list_of(number("m")), required,
           "Radii of the pulleys, one for each node: negative if the rope turns them backwards about `axis`, 0 for a "
           "point."},
          {"axis", direction().as_axial().in_inertial_axes(), optional,
           "Direction of the axes of all pulleys as drawn; points need none."},
          {"at", list_of(KeyForms{vector3("m").as_point(), null()}), computed("the nodes"),
           "Centres of the pulleys, each in the axes of its node; `~` is the node itself."},
          {"EA", number("N").positive(), required, "Stiffness per strain: Young's modulus times area."},
          {"pretension", number("N").non_negative(), otherwise("0"), "Tension as drawn."},
          {"damping", number("s").non_negative(), otherwise("0"), "Time constant of Kelvin-Voigt damping."}};
}

}  // namespace

const KeyTable& belt_keys() {
  static const KeyTable table{"a belt", "A closed belt or chain that grips its pulleys.", rope_keys()};
  return table;
}

const KeyTable& cable_keys() {
  using namespace keys;
  static const KeyTable table{
      "a cable", "A rope from the first node to the last, over pulleys on which it slides without friction.",
      joined({rope_keys(),
              {{"grips", list_of(name_of("node")), optional, "Nodes of pulleys that the rope grips."},
               {"turns", list_of(KeyForms{integer().non_negative(), null()}), optional,
                "Whole turns round each pulley in addition to the rope as drawn; `~` is none."}}})};
  return table;
}

void read_belt(const std::string& name, const YamlValue& entry, Model& model) {
  const RopePath path = read_path(entry, model);
  const RopeMaterial material = read_material(entry);
  refuse_starts_beyond_half_a_turn(entry, nodes_with_pulleys(path), model);
  const std::size_t count = path.nodes.size();
  if (path.nodes.front() == path.nodes.back())
    entry.at("nodes").fail("a belt closes by itself: name its first node once");
  for (std::size_t k = 0; k < count; ++k)
    if (path.pulleys[k].radius == 0) entry.at("radii").fail("a belt runs over pulleys: radii other than 0");
  std::vector<const RopeSection*> sections;
  for (std::size_t k = 0; k < count; ++k)
    sections.push_back(
        &add_section("belt", name, path, {k, (k + 1) % count}, material, entry, Recorded::stacked, model));
  add_grips(name, sections, true, model);
  add_course(name, path, true, model);
}

void read_cable(const std::string& name, const YamlValue& entry, Model& model) {
  const RopePath path = read_path(entry, model);
  const RopeMaterial material = read_material(entry);
  refuse_starts_beyond_half_a_turn(entry, nodes_with_pulleys(path), model);
  std::vector<bool> grips(path.nodes.size(), false);
  grips.front() = grips.back() = true;
  if (const auto given = entry.find("grips"))
    for (const YamlValue& item : given->items()) {
      const int node = node_named_by(item, model);
      bool found = false;
      for (std::size_t k = 0; k < path.nodes.size(); ++k)
        if (path.nodes[k] == node) grips[k] = found = true;
      if (!found) item.fail("is none of the cable's nodes");
    }
  for (std::size_t k = 0; k < path.nodes.size(); ++k)
    if (path.turns[k] > 0 && (grips[k] || path.pulleys[k].radius == 0))
      entry.at("turns").at(k).fail("is for pulleys on which the rope slides: it begins or ends here, or there is none");
  std::vector<std::size_t> places{0};
  std::vector<std::vector<std::size_t>> sections;
  for (std::size_t k = 1; k < path.nodes.size(); ++k) {
    places.push_back(k);
    if (!grips[k]) continue;
    sections.push_back(places);
    places = {k};
  }
  const Recorded recorded = sections.size() > 1 ? Recorded::stacked : Recorded::alone;
  std::vector<const RopeSection*> added;
  for (const std::vector<std::size_t>& section : sections)
    added.push_back(&add_section("cable", name, path, section, material, entry, recorded, model));
  add_grips(name, added, false, model);
  add_course(name, path, false, model);
}

}  // namespace bielle::mechanism
