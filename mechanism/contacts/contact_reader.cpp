// Reader of `contact`: its shapes, the pairs that may touch, and the laws of their surfaces.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "mechanism/contacts/contact.hpp"
#include "mechanism/math/axes_along.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_file.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "mechanism/reading/read_numbers.hpp"

namespace bielle::mechanism {
namespace {

const std::vector<std::string> shape_words = {"sphere", "plane", "capsule", "cylinder", "box", "surface"};

/// Reads the rounding radius of the edges of a box or cylinder. @param thinnest  the smallest of their dimensions
double read_rounding(const YamlValue& entry, double thinnest) {
  const auto given = entry.find("rounding");
  if (!given) return 0.05 * thinnest;
  const double rounding = given->number();
  if (rounding >= 0.5 * thinnest)
    given->fail(
        fmt::format("edges are rounded by less than half of the shape's thinnest part, {:.6g} m", 0.5 * thinnest));
  return rounding;
}

double length_unit(const YamlValue& entry) {
  const std::string unit = entry.at("units").word();
  return unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : unit == "inch" ? 0.0254 : 1;
}

void read_dimensions(const YamlValue& entry, const std::string& word, ContactShape& shape) {
  using Kind = ContactShape::Kind;
  const YamlValue given = entry.at(word);
  if (word == "sphere") {
    shape.kind = Kind::sphere;
    shape.radius = given.number();
  } else if (word == "plane") {
    shape.kind = Kind::plane;
    shape.frame.R = shape.frame.R * axes_along(given.direction());
  } else if (word == "capsule" || word == "cylinder") {
    const VectorX sizes = read_numbers(given, 2, "[radius, length]");
    shape.kind = word == "capsule" ? Kind::capsule : Kind::cylinder;
    shape.radius = sizes[0];
    shape.half_length = 0.5 * sizes[1];
    if (shape.kind == Kind::cylinder) shape.rounding = read_rounding(entry, std::min(2 * sizes[0], sizes[1]));
  } else if (word == "box") {
    shape.kind = Kind::box;
    shape.half = 0.5 * read_numbers(given, 3, "[length along x, y, z]");
    shape.rounding = read_rounding(entry, 2 * shape.half.minCoeff());
  } else {
    shape.kind = Kind::surface;
    const double unit = length_unit(entry);
    shape.surface = read_named_file(
        given, [&](const std::string& path) { return std::make_shared<const TriangleSurface>(read_stl(path, unit)); });
    if (!entry.has("units") && shape.surface->size() > 20)
      given.warn(
          fmt::format("is {:.3g} m from end to end; are its lengths in mm? Then `units: mm`", shape.surface->size()));
    if (shape.surface->flipped_edges() > 0)
      given.warn(
          fmt::format("has {} edges at which inside and outside change places: triangles are listed "
                      "anticlockwise, seen from outside",
                      shape.surface->flipped_edges()));
  }
}

const KeyTable& shape_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const KeyForm size = number("m").positive();
    return KeyTable{
        "a shape of a contact", "A shape on a node, which pushes others away.",
        joined(
            {{{"node", name_of("node"), required, "Node that carries the shape."},
              {"at", vector3("m").as_point(), otherwise("[0, 0, 0]"),
               "Middle of the shape, point of a plane or origin of a surface's file, in the axes of the node."}},
             orientation_keys(),
             {{"sphere", size, optional, "Sphere, by its radius."},
              {"plane", direction().as_vector(), optional,
               "Plane, by its normal towards the outside in the axes of the node; everything below is solid. Planes "
               "do not touch planes."},
              {"capsule", list_of(2, size), optional,
               "Capsule along z: radius, and length between the middles of its round ends."},
              {"cylinder", list_of(2, size), optional, "Cylinder along z: radius and length."},
              {"box", list_of(3, size), optional, "Box: lengths along x, y, z."},
              {"surface", file("STL"), optional,
               "Closed or open surface of triangles, anticlockwise seen from outside; the file is binary or text. "
               "Surfaces do not touch surfaces."},
              {"units", word({"m", "mm", "cm", "inch"}, "a unit of length"), otherwise("m"),
               "Unit of length of the surface's file."},
              {"rounding", size, computed("5 % of the thinnest dimension"),
               "Radius by which the edges of a box or cylinder are rounded."},
              {"velocity", vector3("m/s").as_vector(), otherwise("[0, 0, 0]"),
               "Velocity of the surface's material on the node (a conveyor belt), in the node's axes, for `friction` "
               "of the model `coulomb`."},
              {"angular_velocity", vector3("rad/s").as_axial(), otherwise("[0, 0, 0]"),
               "Angular velocity of the material about `at` (a turntable), likewise."}}})};
  }();
  return table;
}

ContactShape read_shape(const YamlValue& given, const Model& model) {
  const YamlValue entry = given.keyed(shape_keys());
  std::string word;
  for (const std::string& each : shape_words) {
    if (!entry.has(each)) continue;
    if (!word.empty()) entry.fail(fmt::format("has two shapes, `{}` and `{}`", word, each));
    word = each;
  }
  if (word.empty()) entry.fail("give the shape: `sphere`, `plane`, `capsule`, `cylinder`, `box` or `surface`");
  ContactShape shape;
  shape.node = node_named_by(entry.at("node"), model);
  shape.node_name = model.node(shape.node).name;
  shape.frame.x = entry.at("at").vector3();
  shape.frame.R = read_orientation(entry);
  read_dimensions(entry, word, shape);
  if (const auto rounding = entry.find("rounding");
      rounding && shape.kind != ContactShape::Kind::box && shape.kind != ContactShape::Kind::cylinder)
    rounding->fail("belongs to a box or a cylinder");
  if (const auto units = entry.find("units"); units && shape.kind != ContactShape::Kind::surface)
    units->fail("belongs to a `surface`; all else is in metres");
  shape.belt_velocity = shape.frame.R.transpose() * entry.at("velocity").vector3();
  shape.belt_spin = shape.frame.R.transpose() * entry.at("angular_velocity").vector3();
  shape.complete();
  return shape;
}

/// Returns the node that carries a node, and whether it is fixed.
std::pair<int, bool> moves_with(int node, const Model& model) {
  while (const auto carrier = model.node(node).carrier) node = *carrier;
  const auto& freedom = model.node(node).freedom;
  return {node, std::all_of(freedom.begin(), freedom.end(), [](Freedom f) { return f == Freedom::fixed; })};
}

struct ReadShapes {
  std::vector<ContactShape> shapes;
  std::vector<YamlValue> entries;
  std::vector<int> group;  ///< shapes of one group do not touch; -1: in no group
};

/// Checks that a surface whose material moves on its body has Coulomb friction: without friction the motion has no
/// effect, and bristles do not follow it.
void check_belts(const ReadShapes& read, const SurfaceLaw& law) {
  for (std::size_t k = 0; k < read.shapes.size(); ++k) {
    if (!read.shapes[k].has_belt()) continue;
    const YamlValue& entry = read.entries[k];
    const YamlValue given = entry.at(entry.has("velocity") ? "velocity" : "angular_velocity");
    if (!law.friction) given.fail("has an effect only with `friction` of the contact");
    if (law.friction->model != FrictionLaw::Model::coulomb)
      given.fail("goes with the friction `model: coulomb`: bristles do not follow a surface that moves on its body");
  }
}

ReadShapes read_shapes(const YamlValue& entry, const Model& model) {
  if (entry.has("shapes") == entry.has("between"))
    entry.fail("a contact takes either `shapes`, which may all touch each other, or `between`, two lists of shapes");
  ReadShapes read;
  const auto add = [&](const YamlValue& list, int group) {
    for (const YamlValue& item : list.items()) {
      read.shapes.push_back(read_shape(item, model));
      read.entries.push_back(item);
      read.group.push_back(group);
    }
  };
  if (const auto shapes = entry.find("shapes")) {
    add(*shapes, -1);
    if (read.shapes.size() < 2) shapes->fail("expected at least two shapes");
    return read;
  }
  const YamlValue between = entry.at("between");
  const std::vector<YamlValue> groups = between.items();
  if (groups.size() != 2) between.fail("expected two lists of shapes");
  for (const int k : {0, 1}) {
    add(groups[static_cast<std::size_t>(k)], k);
    if (groups[static_cast<std::size_t>(k)].size() == 0)
      groups[static_cast<std::size_t>(k)].fail("expected at least one shape");
  }
  return read;
}

std::vector<std::pair<int, int>> pairs_of(const ReadShapes& read, const YamlValue& entry, const Model& model) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t a = 0; a < read.shapes.size(); ++a)
    for (std::size_t b = a + 1; b < read.shapes.size(); ++b) {
      const ContactShape &first = read.shapes[a], &second = read.shapes[b];
      if (read.group[a] >= 0 && read.group[a] == read.group[b]) continue;
      const auto [first_node, first_fixed] = moves_with(first.node, model);
      const auto [second_node, second_fixed] = moves_with(second.node, model);
      if (first_node == second_node || (first_fixed && second_fixed)) continue;
      if (!can_touch(first.kind, second.kind))
        read.entries[b].fail(fmt::format("contact of a {} with a {} is not supported; a {} can touch: {}",
                                         second.kind_name(), first.kind_name(), second.kind_name(),
                                         touchable_kinds(second.kind)));
      pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
    }
  if (pairs.empty())
    (entry.has("shapes") ? entry.at("shapes") : entry.at("between"))
        .fail("no two of them can touch: they belong to the same node, or neither of them can move");
  return pairs;
}

const KeyTable& contact_friction_keys() {
  static const KeyTable table{"the friction of a contact", "Friction of the surfaces that touch.",
                              keys_of_friction_law({"coulomb", "lugre"})};
  return table;
}

}  // namespace

const KeyTable& contact_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const KeyForm shape = nested(shape_keys);
    return KeyTable{
        "a contact", "Shapes on nodes that push each other apart when they touch.",
        joined({{type_key(),
                 {"shapes", list_of(shape).items_at_least(2), optional,
                  "Shapes, every two of which may touch if they are on different nodes, unless neither can move."},
                 {"between", list_of(2, list_of(shape).items_at_least(1)), optional,
                  "Two lists of shapes, in place of `shapes`: those of one list touch those of the other alone."}},
                keys_of_normal_law(),
                {{"friction", nested(contact_friction_keys), optional, "Friction of the surfaces."},
                 {"rolling_resistance", number("m").non_negative(), optional,
                  "Arm b of a couple against rolling, b times the normal force."},
                 {"rolling_rate", number("rad/s").positive(), otherwise("0.01"),
                  "Angular velocity w_0 within which the couple is smooth, b N tanh(w/w_0)."}}})};
  }();
  return table;
}

void read_contact(const std::string& name, const YamlValue& entry, Model& model) {
  SurfaceLaw law;
  law.normal = read_normal_law(entry);
  if (const auto friction = entry.find("friction")) {
    law.friction = read_friction_law(*friction);
  }
  if (const auto rolling = entry.find("rolling_resistance")) {
    law.rolling.emplace();
    law.rolling->kinetic = law.rolling->sticking = rolling->number();
    law.rolling->velocity = entry.at("rolling_rate").number();
    if (law.rolling->kinetic == 0) law.rolling.reset();
  } else if (const auto rate = entry.find("rolling_rate")) {
    rate->fail("belongs to a `rolling_resistance`");
  }
  ReadShapes read = read_shapes(entry, model);
  check_belts(read, law);
  std::vector<std::pair<int, int>> pairs = pairs_of(read, entry, model);
  auto contact = std::make_unique<Contact>(name, std::move(read.shapes), std::move(pairs), law);
  std::string depth;
  double share = 0;
  try {
    std::tie(depth, share) = contact->drawn_into_each_other(model);
  } catch (const InputError& error) {
    entry.fail(error.what());
  }
  if (share > 0.02) entry.warn(depth + ": they will be thrown apart");
  contact->set_remark(depth);
  model.add_within(std::move(contact), Entry{Section::joints, name}, Entry{Section::contacts, name});
}

}  // namespace bielle::mechanism
