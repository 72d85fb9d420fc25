// `belt` and `cable`: their keys.
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/joints/cables/rope_section.hpp"
#include "mechanism/joints/counted_from_drawing.hpp"
#include "mechanism/math/axes_along.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/yaml_file.hpp"

namespace bielle::mechanism {
namespace {

/// The places that a rope passes, in order.
struct RopePath {
  std::vector<int> nodes;
  std::vector<std::string> names;
  std::vector<Pulley> pulleys;
  std::vector<Frame> drawn;
};

/// One point for each node, in the node's axes; `~`: the node itself.
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
  return path;
}

std::vector<int> nodes_with_pulleys(const RopePath& path) {
  std::vector<int> nodes;
  for (std::size_t k = 0; k < path.nodes.size(); ++k)
    if (path.pulleys[k].radius != 0 && path.nodes[k] != 0) nodes.push_back(path.nodes[k]);
  return nodes;
}

RopeMaterial read_material(const YamlValue& entry) {
  RopeMaterial material{entry.at("EA").positive_number()};
  if (const auto damping = entry.find("damping")) material.damping = damping->non_negative_number();
  if (const auto pretension = entry.find("pretension")) material.pretension = pretension->non_negative_number();
  return material;
}

/// Adds the section from one place of the path to another.
void add_section(const char* type, const std::string& name, const RopePath& path,
                 const std::vector<std::size_t>& places, const RopeMaterial& material, const YamlValue& entry,
                 Recorded recorded, Model& model) {
  RopePath part;
  for (const std::size_t k : places) {
    part.nodes.push_back(path.nodes[k]);
    part.names.push_back(path.names[k]);
    part.pulleys.push_back(path.pulleys[k]);
    part.drawn.push_back(path.drawn[k]);
  }
  try {
    model.add(std::make_unique<RopeSection>(type, name, part.nodes, part.names, part.pulleys, material, part.drawn),
              Entry{Section::joints, name}, recorded);
  } catch (const std::domain_error& error) {
    entry.at("radii").fail(error.what());
  }
}

}  // namespace

void read_belt(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"type", "nodes", "radii", "axis", "at", "EA", "pretension", "damping"}, "a belt");
  const RopePath path = read_path(entry, model);
  const RopeMaterial material = read_material(entry);
  refuse_starts_beyond_half_a_turn(entry, nodes_with_pulleys(path), model);
  const std::size_t count = path.nodes.size();
  if (path.nodes.front() == path.nodes.back())
    entry.at("nodes").fail("a belt closes by itself: name its first node once");
  for (std::size_t k = 0; k < count; ++k)
    if (path.pulleys[k].radius == 0) entry.at("radii").fail("a belt runs over pulleys: radii other than 0");
  for (std::size_t k = 0; k < count; ++k)
    add_section("belt", name, path, {k, (k + 1) % count}, material, entry, Recorded::stacked, model);
}

void read_cable(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"type", "nodes", "radii", "axis", "at", "grips", "EA", "pretension", "damping"}, "a cable");
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
  std::vector<std::size_t> places{0};
  std::vector<std::vector<std::size_t>> sections;
  for (std::size_t k = 1; k < path.nodes.size(); ++k) {
    places.push_back(k);
    if (!grips[k]) continue;
    sections.push_back(places);
    places = {k};
  }
  const Recorded recorded = sections.size() > 1 ? Recorded::stacked : Recorded::alone;
  for (const std::vector<std::size_t>& section : sections)
    add_section("cable", name, path, section, material, entry, recorded, model);
}

}  // namespace bielle::mechanism
