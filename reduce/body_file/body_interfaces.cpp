#include "reduce/body_file/body_interfaces.hpp"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/body_file/body_axes.hpp"
#include "reduce/body_file/body_surfaces.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

const std::vector<std::string> direction_words = {"x", "y", "z", "rx", "ry", "rz"};

}  // namespace

void check_name(const std::string& name, const YamlValue& value) {
  if (name.empty() || name.find('/') != std::string::npos) value.fail("expected a name without '/'");
}

KeyForm tie_form() { return keys::word({"rigid", "average", "free"}, "a tie"); }

KeyForm directions_form() { return keys::list_of(keys::word(direction_words, "a direction")).items_at_least(1); }

Tie read_tie(const YamlValue& value) {
  const std::string word = value.word();
  return word == "rigid" ? Tie::rigid : word == "average" ? Tie::average : Tie::free;
}

std::array<bool, 6> read_directions(const YamlValue& value, Tie tie) {
  std::array<bool, 6> kept{};
  for (const YamlValue& item : value.items()) {
    const auto found = std::find(direction_words.begin(), direction_words.end(), item.word());
    const std::size_t k = found - direction_words.begin();
    if (kept[k]) item.fail(fmt::format("'{}' stands here twice", *found));
    if (k >= 3 && tie == Tie::free) item.fail("the nodes of a free interface have no rotations; expected x, y or z");
    kept[k] = true;
  }
  if (value.size() == 0) value.fail("expected at least one direction out of x, y, z, rx, ry, rz");
  return kept;
}

const KeyTable& interface_keys() {
  using namespace keys;
  static const KeyTable table{
      "an interface",
      "A surface by which a mechanism moves the body; it becomes a node of the superelement.",
      {{"surface", surface_forms(), required,
        "The surface: a physical surface by its name, a shape, or a list of both, which is their union. Surfaces of "
        "different interfaces must not touch."},
       {"tie", tie_form(), otherwise("rigid"),
        "The relation of the surface to the node: `rigid` (RBE2, kinematic coupling): the surface moves with the node "
        "as a rigid body; `average` (RBE3, distributing coupling): the node moves as the area-weighted mean of the "
        "surface, which stays flexible; `free`: every mesh node of the surface is an interface node of its own, with 3 "
        "translations."},
       {"position", vector3("m"), computed("the centroid of the surface"), "Position of the node."},
       {"axes", nested(axes_keys), computed("the axes of the body"), "Directions of the node's axes in the body."},
       {"rotation_vector", vector3("rad"), optional,
        "Rotation from the axes of the body to those of the node, in place of `axes`: its axis times its angle."},
       {"directions", directions_form(), computed("all; x, y, z of a free interface"),
        "Kept directions, in the axes of the node."}}};
  return table;
}

InterfaceRequest read_interface(const std::string& name, const YamlValue& value, MeshRequest& mesh) {
  check_name(name, value);
  InterfaceRequest interface;
  interface.name = name;
  interface.subject = value.path();
  interface.group = read_surface(value, "surface", mesh);
  interface.tie = read_tie(value.at("tie"));
  if (interface.tie == Tie::free) {
    interface.kept = {true, true, true, false, false, false};
    for (const char* key : {"position", "axes", "rotation_vector"})
      if (const auto given = value.find(key))
        given->fail("a free interface is each of its nodes where it is, along the axes of the body: remove this key");
  }
  if (const auto position = value.find("position")) interface.position = position->vector3();
  const auto axes = value.find("axes"), rotation = value.find("rotation_vector");
  if (axes && rotation) value.fail("expected either axes or rotation_vector, not both");
  if (axes) interface.rotation = read_axes(*axes);
  if (rotation) {
    const Eigen::Vector3d psi = rotation->vector3();
    if (psi.norm() > 0) interface.rotation = Eigen::AngleAxisd(psi.norm(), psi.normalized()).toRotationMatrix();
  }
  if (const auto directions = value.find("directions")) interface.kept = read_directions(*directions, interface.tie);
  return interface;
}

}  // namespace bielle::reduce
