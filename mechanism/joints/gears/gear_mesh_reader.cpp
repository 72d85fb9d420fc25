// Reader of `gear_mesh`, and of the position of the mesh.
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/joints/counted_from_drawing.hpp"
#include "mechanism/joints/gears/gear_mesh.hpp"
#include "mechanism/joints/gears/tooth_directions.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {
namespace {

constexpr PlausibleRange plausible_tooth_play{0, 0.05, "Teeth have a play of 1e-5 to 1e-3 m"};
constexpr double fit = 1e-6;  ///< relative tolerance between radii and the distance of centres

/// The given data in initial inertial components.
struct DrawnWheels {
  std::array<Vector3, 2> axis, centre;
};

std::array<Vector3, 2> read_axes(const YamlValue& axes) {
  // The value is one direction for both wheels, or a pair.
  if (axes.is_sequence() && axes.size() == 2 && axes.at(0).is_sequence())
    return {axes.at(0).direction(), axes.at(1).direction()};
  const Vector3 both = axes.direction();
  return {both, both};
}

/// Returns the pitch point of wheels on parallel axes, from their radii.
Vector3 pitch_point_of_radii(const YamlValue& given, const DrawnWheels& wheels, bool internal) {
  const Eigen::VectorXd radii = read_numbers(given, 2, "[pitch radius of the first wheel, of the second]");
  const Vector3& z = wheels.axis[0];
  if (z.cross(wheels.axis[1]).norm() > 1e-6)
    given.fail("belong to wheels on parallel axes; for other axes give `position`, the point where the teeth meet");
  const Vector3 way = wheels.centre[1] - wheels.centre[0];
  const Vector3 across = way - z * z.dot(way);
  const double distance = across.norm(), wanted = internal ? std::abs(radii[0] - radii[1]) : radii[0] + radii[1];
  if (std::abs(distance - wanted) > fit * (radii[0] + radii[1]))
    given.fail(
        fmt::format("make a distance of axes of {:.9g} m; the wheels are drawn {:.9g} m apart", wanted, distance));
  if (wanted <= fit * (radii[0] + radii[1])) given.fail("of an internal gear must differ");
  const double towards = internal && radii[0] < radii[1] ? -1 : 1;
  return wheels.centre[0] + 0.5 * z * z.dot(way) + towards * radii[0] * across / distance;
}

Vector3 read_pitch_point(const YamlValue& entry, const DrawnWheels& wheels, bool internal) {
  if (entry.has("radii") == entry.has("position"))
    entry.fail(
        "a gear mesh takes either `radii` (of wheels on parallel axes) or `position`, the point where the teeth meet");
  return entry.has("radii") ? pitch_point_of_radii(entry.at("radii"), wheels, internal)
                            : entry.at("position").vector3();
}

/// @param range  words of the message for the angles that are allowed; the form of the key refuses negative ones
double read_angle_below_quarter(const YamlValue& given, const char* range) {
  const double angle = given.number();
  if (std::abs(angle) >= M_PI / 2) given.fail(fmt::format("expected an angle {} [rad]", range));
  return angle;
}

ToothGeometry read_geometry(const YamlValue& entry, const std::array<int, 3>& nodes, const Model& model) {
  const Frame& carrier = model.node(nodes[0]).frame;
  DrawnWheels wheels{read_axes(entry.at("axes")), {model.node(nodes[1]).frame.x, model.node(nodes[2]).frame.x}};
  const bool internal = entry.at("internal").boolean();
  const Vector3 P = read_pitch_point(entry, wheels, internal);
  ToothGeometry geometry;
  const auto seen = [&](const Vector3& point) -> Vector3 { return carrier.R.transpose() * (point - carrier.x); };
  std::array<double, 2> radius{};
  for (std::size_t k = 0; k < 2; ++k) {
    geometry.axis[k] = carrier.R.transpose() * wheels.axis[k];
    geometry.centre[k] = seen(wheels.centre[k]);
    geometry.wheel[k] = model.node(nodes[k + 1]).frame.R.transpose() * carrier.R;
    radius[k] = wheels.axis[k].cross(P - wheels.centre[k]).norm();
  }
  geometry.P = seen(P);
  geometry.pressure_angle = read_angle_below_quarter(entry.at("pressure_angle"), "of at least 0 and less than pi/2");
  const double helix = read_angle_below_quarter(entry.at("helix_angle"), "between -pi/2 and pi/2");
  try {
    set_tooth_directions(geometry, helix, internal && radius[0] > radius[1]);
  } catch (const std::domain_error& error) {
    (entry.has("position") ? entry.at("position") : entry.at("axes")).fail(error.what());
  }
  return geometry;
}

}  // namespace

const KeyTable& gear_mesh_keys() {
  using namespace keys;
  static const KeyTable table{
      "a gear mesh",
      "Forces between the teeth of two wheels, which load the bearings.",
      {type_key(),
       {"nodes", list_of(2, name_of("node")), required, "Nodes of the two wheels, on their axes."},
       {"carrier", name_of("node"), otherwise("ground"), "Node that carries the bearings of the wheels."},
       {"axes",
        {direction().as_axial().in_inertial_axes(), list_of(2, direction().as_axial())},
        required,
        "Direction of both axes, or of the axis of each wheel, as drawn."},
       {"radii", list_of(2, number("m").positive()), optional, "Pitch radii of wheels on parallel axes."},
       {"position", vector3("m").as_point().in_inertial_axes(), optional,
        "Point where the teeth meet, as drawn, in place of `radii`."},
       {"internal", boolean(), otherwise("false"), "Whether the larger wheel is a ring with teeth inside."},
       {"pressure_angle", number("rad").non_negative(), otherwise("pi/9"), "Pressure angle, less than pi/2."},
       {"helix_angle", number("rad"), otherwise("0"),
        "Helix angle of the first wheel, between -pi/2 and pi/2; right-handed teeth have a positive one."},
       {"stiffness", tooth_stiffness_forms(), optional,
        "Stiffness of the teeth along their normal, also as a formula of the angles phi of the first and phi_2 of the "
        "second wheel; without it the pitch surfaces roll on each other exactly."},
       {"damping", number("N s/m").non_negative(), otherwise("0"), "Damping of elastic teeth along their normal."},
       {"backlash", number("m").non_negative(), otherwise("0"), "Free play of elastic teeth along their normal."},
       {"errors", tooth_error_forms(), optional,
        "Errors of the teeth along their normal, by which the second wheel is ahead when it is not loaded; also as a "
        "formula of the angles phi of the first and phi_2 of the second wheel."}}};
  return table;
}

void read_gear_mesh(const std::string& name, const YamlValue& entry, Model& model) {
  const std::vector<int> wheels = nodes_named_by(entry.at("nodes"), 2, model);
  const std::array<int, 3> nodes{node_named_by(entry.at("carrier"), model), wheels[0], wheels[1]};
  if (wheels[0] == wheels[1]) entry.at("nodes").fail("a gear mesh needs two different wheels");
  for (const int wheel : wheels)
    if (wheel == nodes[0])
      entry.at(entry.has("carrier") ? "carrier" : "nodes").fail("a wheel cannot be its own carrier");
  const std::array<std::string, 3> names{model.node(nodes[0]).name, model.node(nodes[1]).name,
                                         model.node(nodes[2]).name};
  const ToothGeometry geometry = read_geometry(entry, nodes, model);
  refuse_starts_beyond_half_a_turn(entry, wheels, model);
  const Entry own{Section::joints, name};
  MeshFunction errors;
  if (const auto given = entry.find("errors")) errors = read_tooth_errors(*given);
  if (const auto stiffness = entry.find("stiffness")) {
    if (const auto backlash = entry.find("backlash")) warn_outside(*backlash, backlash->number(), plausible_tooth_play);
    ToothSpring spring{
        read_tooth_stiffness(*stiffness, geometry, entry.at("helix_angle").number(), entry.at("internal").boolean()),
        entry.at("damping").number(), entry.at("backlash").number()};
    model.add(std::make_unique<ElasticGearMesh>(name, nodes, names, geometry, std::move(errors), std::move(spring)),
              own);
    return;
  }
  for (const char* key : {"damping", "backlash"})
    if (const auto too_much = entry.find(key)) too_much->fail("needs the `stiffness` of the teeth");
  auto mesh = std::make_unique<RigidGearMesh>(name, nodes, names, geometry, std::move(errors));
  const RigidGearMesh& rigid = *mesh;
  model.add(std::move(mesh), own);
  if (geometry.pressure_angle > 0) model.add(std::make_unique<GearSeparation>(name, rigid), own, Recorded::no);
}

}  // namespace bielle::mechanism
