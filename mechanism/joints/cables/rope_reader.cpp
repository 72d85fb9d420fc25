// Readers of `belt` and `cable`.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "mechanism/joints/cables/divided_rope.hpp"
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

/// Reads one coefficient of friction for all pulleys, or one for each node; `~`: none.
/// @param held  for each place, whether the rope is fixed or gripped there
RopeFrictions read_frictions(const YamlValue& entry, const RopePath& path, const std::vector<bool>& held) {
  const std::size_t count = path.nodes.size();
  RopeFrictions frictions(count);
  const auto given = entry.find("friction");
  if (!given) return frictions;
  if (!given->is_sequence()) {
    bool any = false;
    for (std::size_t k = 0; k < count; ++k) {
      if (held[k] || path.pulleys[k].radius == 0) continue;
      frictions[k] = given->number();
      any = true;
    }
    if (!any) given->fail("there is no pulley on which the rope could slip: it is gripped or ends at all of them");
    return frictions;
  }
  if (given->size() != count)
    given->fail(
        fmt::format("expected {} coefficients, one for each node (`~`: no friction), or one for all pulleys", count));
  for (std::size_t k = 0; k < count; ++k) {
    const YamlValue item = given->at(k);
    if (item.is_null()) continue;
    if (held[k]) item.fail("is for pulleys on which the rope can slip: it is gripped or ends here");
    if (path.pulleys[k].radius == 0) item.fail("is for a pulley: the radius is 0 here");
    frictions[k] = item.number();
  }
  return frictions;
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

KeyForm list_of_frictions() {
  using namespace keys;
  return list_of(KeyForms{number().non_negative(), null()});
}

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
  using namespace keys;
  static const KeyTable table{"a belt",
                              "A closed belt or chain that grips its pulleys, or slips on them with friction.",
                              joined({rope_keys(),
                                      {{"friction", list_of_frictions(), optional,
                                        "Coefficients of friction, one for each node; the belt grips pulleys with `~` "
                                        "without slip, one at least."}}})};
  return table;
}

const KeyTable& cable_keys() {
  using namespace keys;
  static const KeyTable table{
      "a cable", "A rope from the first node to the last, over pulleys on which it slides, with friction or without.",
      joined({rope_keys(),
              {{"grips", list_of(name_of("node")), optional, "Nodes of pulleys that the rope grips."},
               {"friction", KeyForms{number().non_negative(), list_of_frictions()}, optional,
                "Coefficient of friction on all pulleys between the ends, or on each; the rope slides on the others "
                "(`~`) without friction."},
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
  if (const auto given = entry.find("friction"); given && !given->is_sequence())
    given->fail("expected a list with a coefficient or `~` for each node: a belt grips one of its pulleys at least");
  const RopeFrictions frictions = read_frictions(entry, path, std::vector<bool>(count, false));
  const auto slips = [](const std::optional<double>& each) { return each.has_value(); };
  if (std::all_of(frictions.begin(), frictions.end(), slips))
    entry.at("friction")
        .fail(
            "a belt cannot slip on all pulleys at once: let it grip (`~`) the one with the largest product of "
            "coefficient and wrap, on which it would slip last");
  std::vector<std::vector<std::size_t>> sections;
  for (std::size_t k = 0; k < count; ++k) sections.push_back({k, (k + 1) % count});
  DividedRope("belt", name, path, material, frictions, entry, model).add(sections, true);
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
  const RopeFrictions frictions = read_frictions(entry, path, grips);
  std::vector<std::size_t> places{0};
  std::vector<std::vector<std::size_t>> sections;
  for (std::size_t k = 1; k < path.nodes.size(); ++k) {
    places.push_back(k);
    if (!grips[k] && !frictions[k]) continue;
    sections.push_back(places);
    places = {k};
  }
  DividedRope("cable", name, path, material, frictions, entry, model).add(sections, false);
  add_course(name, path, false, model);
}

}  // namespace bielle::mechanism
