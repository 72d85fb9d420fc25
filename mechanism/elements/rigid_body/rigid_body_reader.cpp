// Readers of rigid bodies and point masses in the mechanism file.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "mechanism/drawing/reading/shape_reader.hpp"
#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/elements/rigid_body/solid_reader.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "reduce/superelement/inertia_tensor.hpp"

namespace bielle::mechanism {
namespace {

/// Reads `inertia`, about the centre of mass or, with `inertia_about: node`, about the node; in the node's axes or,
/// with `inertia_axes: {orientation}`, in rotated axes.
Matrix3 read_inertia(const YamlValue& entry, double mass, const Vector3& centre) {
  const YamlValue value = entry.at("inertia");
  Matrix3 J = read_inertia_tensor(value);
  if (const auto axes = entry.find("inertia_axes")) {
    const Matrix3 R = read_orientation(*axes);
    J = R * J * R.transpose();
  }
  const bool about_node = entry.at("inertia_about").word() == "node";
  if (about_node) J += mass * skew(centre) * skew(centre);
  const std::string fault = inertia_fault(J);
  if (!fault.empty())
    value.fail(fault + (about_node
                            ? ". Is the tensor about the node? (`inertia_about: centre` is the default)"
                            : ". Is the tensor about the centre of mass (else: `inertia_about: node`), and are the "
                              "products of inertia entries of the tensor? A mass without inertia is a `point_mass`"));
  return J;
}

/// Refuses masses and moments of inertia of bodies of extreme size that cannot be represented.
void check_representable(const YamlValue& entry, const MassProperties& p) {
  if (!(p.mass > 0 && std::isfinite(p.mass) && p.inertia_about_origin().allFinite()))
    entry.fail("the mass or the inertia is too large or too small for a number; lengths are in m, masses in kg");
}

/// Warns of masses and inertias that may be given in other units. A compact body of mass m and radius of gyration k has
/// an m/k^3 of about 16 times its density. For long and thin bodies it is smaller; inertias in kg mm^2 reduce it by
/// 1e-9.
void warn_of_units(const YamlValue& entry, const MassProperties& p) {
  constexpr double heaviest = 1e7;   // [kg] mass of the steel of the Eiffel tower
  constexpr double lightest = 1e-3;  // smallest m/k^3 [kg/m^3]: that of 1 kg over 35 m
  const YamlValue mass = entry.at(entry.has("solid") ? "solid" : "mass");
  if (p.mass > heaviest)
    mass.warn(fmt::format("are {:.3g} kg meant? Lengths are in metres, densities in kg/m^3, masses in kg", p.mass));
  const auto inertia = entry.find("inertia");
  if (!inertia) return;
  // This is the radius of gyration of a long body; that of others is smaller.
  const double gyration = std::sqrt(0.5 * p.inertia.trace() / p.mass);
  if (p.mass < lightest * gyration * gyration * gyration)
    inertia->warn(
        fmt::format("is this meant? {:.3g} kg with so much inertia reaches over some {:.3g} m; inertias are in "
                    "kg m^2 (1e6 kg mm^2)",
                    p.mass, 3.5 * gyration));
}

/// Reads further nodes that the body carries: they follow its node and must not be held or carried otherwise.
void carry(const YamlValue& also, int carrier, const std::string& body, Model& model) {
  for (const YamlValue& item : also.items()) {
    const int index = node_named_by(item, model);
    Node& node = model.node(index);
    if (node.carrier == carrier)
      item.fail(fmt::format("node '{}' is carried by node '{}' already: does it stand here twice?", node.name,
                            model.node(carrier).name));
    if (index == carrier) item.fail(fmt::format("'{}' is the body's own node; `also` lists further nodes", node.name));
    if (node.carrier)
      item.fail(fmt::format("node '{}' is carried by node '{}' already", node.name, model.node(*node.carrier).name));
    const bool held =
        std::any_of(node.freedom.begin(), node.freedom.end(), [](Freedom f) { return f != Freedom::free; });
    if (held) item.fail(fmt::format("node '{}' is fixed or moved, so '{}' cannot carry it", node.name, body));
    if (!node.velocity.isZero() || !node.angular_velocity.isZero())
      item.fail(fmt::format("node '{}' is given a velocity, but moves with node '{}': give that one the velocity",
                            node.name, model.node(carrier).name));
    for (std::optional<int> above = model.node(carrier).carrier; above; above = model.node(*above).carrier)
      if (*above == index)
        item.fail(fmt::format("node '{}' carries '{}' already: bodies cannot carry each other in a circle", node.name,
                              model.node(carrier).name));
    node.carrier = carrier;
  }
}

void draw_solids(const YamlValue& value, const Entry& own, int node, const Vector3& offset, Model& model) {
  if (!value.is_sequence()) return draw_solid(value.keyed(solid_keys()), own, node, offset, model);
  for (const YamlValue& item : value.items()) draw_solid(item.keyed(solid_keys()), own, node, offset, model);
}

const KeyTable& inertia_axes_keys() {
  static const KeyTable table{"`inertia_axes`", "Axes of an inertia tensor by their orientation.", orientation_keys()};
  return table;
}

}  // namespace

const KeyTable& rigid_body_keys() {
  using namespace keys;
  static const KeyTable table{
      "a rigid_body",
      "A rigid body on a node, by its mass and inertia or by solids.",
      {type_key(),
       {"node", name_of("node"), required, "The node that moves with the body."},
       {"mass", number("kg").positive(), optional, "Mass, which is needed without `solid`."},
       {"centre", vector3("m").as_point(), computed("the node, or the centre of the solid"),
        "Centre of mass in the axes of the node."},
       {"inertia", inertia_tensor_forms(), optional,
        "Inertia tensor as `[xx, yy, zz]`, `[xx, yy, zz, xy, xz, yz]` or three rows of three, which is needed without "
        "`solid`."},
       {"inertia_about", word({"centre", "node"}, "a point for the inertia"), otherwise("centre"),
        "Point about which the inertia is given."},
       {"inertia_axes", nested(inertia_axes_keys), computed("the axes of the node"),
        "Orientation of the axes of the inertia, relative to those of the node."},
       {"solid",
        {nested(solid_keys), list_of(nested(solid_keys)).items_at_least(1)},
        optional,
        "Solid, or list of solids that are added up, in place of mass and inertia."},
       {"also", list_of(name_of("node")), optional, "Further nodes that the body carries rigidly."},
       shape_key()}};
  return table;
}

void read_rigid_body(const std::string& name, const YamlValue& entry, Model& model) {
  const int node = node_named_by(entry.at("node"), model);
  MassProperties p;
  if (const auto solid = entry.find("solid")) {
    for (const char* key : {"mass", "inertia", "inertia_about", "inertia_axes"})
      if (const auto other = entry.find(key)) other->fail("give either `solid` or `mass` and `inertia`");
    p = read_solids(*solid);
    if (const auto centre = entry.find("centre")) {
      if (solids_are_placed(*solid)) centre->fail("the solids have positions of their own; leave `centre` out");
      p.centre = centre->vector3();
    }
  } else {
    p.mass = entry.at("mass").number();
    if (const auto centre = entry.find("centre")) p.centre = centre->vector3();
    p.inertia = read_inertia(entry, p.mass, p.centre);
  }
  check_representable(entry, p);
  warn_of_units(entry, p);
  if (const auto also = entry.find("also")) carry(*also, node, name, model);
  const Entry own{Section::elements, name};
  if (const auto shape = entry.find("shape"))
    read_shapes(*shape, own, node, model);
  else if (const auto solid = entry.find("solid"))
    draw_solids(*solid, own, node, solids_are_placed(*solid) ? Vector3::Zero() : p.centre, model);
  model.add(std::make_unique<RigidBody>("rigid_body", name, node, p, model.node(node).name), own);
}

const KeyTable& point_mass_keys() {
  using namespace keys;
  static const KeyTable table{
      "a point_mass",
      "A mass without inertia about its centre.",
      {type_key(),
       {"node", name_of("node"), required, "The node that moves with the mass."},
       {"mass", number("kg").non_negative(), required, "Mass."},
       {"centre", vector3("m").as_point(), otherwise("[0, 0, 0]"), "Place of the mass in the axes of the node."},
       shape_key()}};
  return table;
}

void read_point_mass(const std::string& name, const YamlValue& entry, Model& model) {
  MassProperties p;
  p.mass = entry.at("mass").number();
  p.centre = entry.at("centre").vector3();
  if (p.mass > 0) check_representable(entry, p);
  const int node = node_named_by(entry.at("node"), model);
  const Entry own{Section::elements, name};
  if (const auto shape = entry.find("shape")) read_shapes(*shape, own, node, model);
  model.add(std::make_unique<RigidBody>("point_mass", name, node, p, model.node(node).name), own);
}

}  // namespace bielle::mechanism
