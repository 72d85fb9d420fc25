#include "reduce/body_file/body_interfaces.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/body_file/body_axes.hpp"
#include "reduce/body_file/body_surfaces.hpp"
#include "reduce/body_file/deck_ties.hpp"
#include "reduce/common/direction_words.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

void check_name(const std::string& name, const YamlValue& value) {
  if (name.empty() || name.find('/') != std::string::npos) value.fail("expected a name without '/'");
}

KeyForm tie_form() { return keys::word({"rigid", "average", "free"}, "a tie"); }

KeyForm directions_form() {
  return keys::list_of(keys::word({direction_words.begin(), direction_words.end()}, "a direction")).items_at_least(1);
}

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

std::vector<std::string> direction_names(const std::array<bool, 6>& directions) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < directions.size(); ++k)
    if (directions[k]) names.push_back(direction_words[k]);
  return names;
}

const KeyTable& interface_keys() {
  using namespace keys;
  static const KeyTable table{
      "an interface",
      "A surface, or a tie of a deck, by which a mechanism moves the body; it becomes a node of the superelement.",
      {{"from", text(), optional,
        "A tie of the Nastran, Abaqus or CalculiX file that is the geometry, in place of `surface`: `RBE2 12`, `RBE3 "
        "6002`, `coupling END`. Its nodes, their weights, the position and the axes of the node are those of the "
        "file."},
       {"surface", surface_forms(), computed("required without `from`"),
        "The surface: a physical surface by its name, a shape, or a list of both, which is their union. Surfaces of "
        "different interfaces must not touch."},
       {"node", integer().positive(), optional, "With `matrices`: a node, in place of `surface`."},
       {"nodes", list_of(integer().positive()).items_at_least(1), optional,
        "With `matrices`: nodes that are tied to the interface, in place of `surface`."},
       {"weights", list_of(number().positive()).items_at_least(1), computed("equal ones"),
        "Weights of the `nodes` of an average tie."},
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

namespace {

/// Reads an interface that is a tie of the deck; `directions` may choose among those that it ties.
void read_from_deck(const YamlValue& value, const YamlValue& from, DeckReader& deck, InterfaceRequest& interface) {
  for (const char* key : {"surface", "tie", "position", "axes", "rotation_vector"})
    if (value.has(key))
      value.at(key).fail(
          fmt::format("the file gives it, as the interface is '{}' of the file: remove this key", from.text()));
  deck.read(from, interface);
  const auto directions = value.find("directions");
  if (!directions) return;
  const std::array<bool, 6> tied = interface.kept;
  interface.kept = read_directions(*directions, interface.tie);
  for (std::size_t k = 0; k < tied.size(); ++k)
    if (interface.kept[k] && !tied[k])
      directions->fail(fmt::format("'{}' does not tie '{}', but {}", from.text(), direction_words[k],
                                   fmt::join(direction_names(tied), ", ")));
}

}  // namespace

InterfaceRequest read_interface(const std::string& name, const YamlValue& value, MeshRequest& mesh, DeckReader& deck) {
  check_name(name, value);
  InterfaceRequest interface;
  interface.name = name;
  interface.subject = value.path();
  for (const char* key : {"node", "nodes", "weights"})
    if (value.has(key)) value.at(key).fail("it belongs to a body of `matrices`; this body has a geometry");
  if (const auto from = value.find("from")) {
    read_from_deck(value, *from, deck, interface);
    return interface;
  }
  if (!value.has("surface")) value.fail("the key 'surface' is missing; or 'from' takes a tie of a deck");
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
  if (rotation) interface.rotation = read_rotation_vector(*rotation);
  if (const auto directions = value.find("directions")) interface.kept = read_directions(*directions, interface.tie);
  return interface;
}

}  // namespace bielle::reduce
