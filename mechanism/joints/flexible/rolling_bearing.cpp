#include "mechanism/joints/flexible/rolling_bearing.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/joints/actions/joint_actions.hpp"
#include "mechanism/joints/flexible/hertz_contact.hpp"
#include "mechanism/joints/flexible/rolling_bearing_law.hpp"
#include "mechanism/reading/read_numbers.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the keys that both kinds have.
std::vector<Key> rolling_keys(const char* constant_unit, const char* element, std::vector<Key> own) {
  using namespace keys;
  KeyForm angle = number("rad").non_negative();
  return joined(
      {joint_frame_keys(AxisNeed::required),
       {{"elements", integer().between(1, 1000), required, fmt::format("Number of {}s.", element)},
        {"pitch_diameter", number("m").positive(), required,
         fmt::format("Diameter of the circle of the {}s.", element)},
        {fmt::format("{}_diameter", element), number("m").positive(), required,
         fmt::format("Diameter of a {}.", element)}},
       std::move(own),
       {{"contact_angle", angle, otherwise("0"),
         "Angle between the contact and the radial plane, below 90 degrees. With an angle the bearing carries the "
         "shaft "
         "along +z of its axis."},
        {"clearance", number("m"), otherwise("0"),
         "Diametral clearance: the radial play of the shaft; negative for an interference."},
        {"axial_preload", number("N").non_negative(), otherwise("0"),
         "Axial force on the shaft at the position as drawn, of a bearing with a contact angle."},
        {"constant", number(constant_unit).positive(), computed("from materials and radii"),
         "Force of an element per deflection of both contacts together, to the power of the law."},
        {"discrete", boolean(), otherwise("false"),
         "Whether single elements pass in a cage, so that the stiffness varies; otherwise they are spread evenly."},
        {"cage_angle", number("rad"), otherwise("0"),
         "Azimuth of the first of discrete elements as drawn, from x about z."}},
       joint_action_keys(Moves::both)});
}

RollingGeometry read_geometry(const YamlValue& entry, bool ball) {
  RollingGeometry geometry;
  geometry.ball = ball;
  geometry.exponent = ball ? 1.5 : 10.0 / 9;
  const YamlValue elements = entry.at("elements");
  geometry.elements = elements.integer();
  if (geometry.elements < 3) elements.fail("expected at least 3");
  geometry.pitch_diameter = entry.at("pitch_diameter").number();
  const YamlValue diameter = entry.at(ball ? "ball_diameter" : "roller_diameter");
  const double D = diameter.number();
  if (D >= geometry.pitch_diameter) diameter.fail("expected less than `pitch_diameter`");
  const double widest = geometry.pitch_diameter * std::sin(std::numbers::pi / geometry.elements);
  if (D > widest)
    diameter.fail(
        fmt::format("{} elements on the pitch circle have room for up to {:.6g} m each", geometry.elements, widest));
  const YamlValue angle = entry.at("contact_angle");
  geometry.contact_angle = angle.number();
  constexpr double largest = 89.0 / 180 * std::numbers::pi;
  if (geometry.contact_angle > largest) angle.fail("expected at most 89 degrees");
  geometry.clearance = entry.at("clearance").number();
  geometry.contact_radius = 0.5 * geometry.pitch_diameter;
  geometry.discrete = entry.at("discrete").boolean();
  geometry.cage_angle = entry.at("cage_angle").number();
  if (!geometry.discrete && entry.has("cage_angle"))
    entry.at("cage_angle").fail("is the place of a discrete element: `discrete: true` is missing");
  geometry.cage_ratio = 0.5 * (1 - D * std::cos(geometry.contact_angle) / geometry.pitch_diameter);
  return geometry;
}

void add_rolling_bearing(const char* type, const std::string& name, const YamlValue& entry,
                         const RollingGeometry& geometry, Model& model) {
  const YamlValue preload = entry.at("axial_preload");
  if (preload.number() > 0 && geometry.contact_angle == 0) preload.fail("an axial force needs a `contact_angle`");
  auto law = std::make_shared<RollingBearingLaw>(geometry, preload.number());
  constexpr double soft = 0.1;
  if (std::abs(law->axial_displacement()) > soft * geometry.pitch_diameter)
    preload.fail(fmt::format("displaces the rings by {:.3g} m: the elements are too soft for it, or its unit is wrong",
                             law->axial_displacement()));
  auto made = std::make_unique<ShaftBearing>(type, name, read_joint_frames(entry, model, AxisNeed::required),
                                             std::move(law), model);
  ShaftBearing& bearing = *made;
  model.add(std::move(made), Entry{Section::joints, name});
  read_joint_actions(entry, bearing, model);
}

/// Returns the force constant of a ball between both rings; the deflections of its two contacts add up.
double constant_of_ball(const RollingGeometry& geometry, double D, const Vector2& grooves, double modulus) {
  const double gamma = D * std::cos(geometry.contact_angle) / geometry.pitch_diameter;
  const auto flexibility = [&](double R_x, double groove) {
    const double R_y = groove * D / (2 * groove - 1);
    return std::pow(hertz_constant(R_x, R_y, modulus), -2.0 / 3);
  };
  const double both = flexibility(0.5 * D * (1 - gamma), grooves[0]) + flexibility(0.5 * D * (1 + gamma), grooves[1]);
  return std::pow(both, -1.5);
}

}  // namespace

const KeyTable& ball_bearing_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const KeyForm modulus = number("Pa").positive(), ratio = number().between(0, 0.5);
    return KeyTable{
        "a ball_bearing", "A deep groove or angular contact ball bearing, by the contacts of its balls.",
        rolling_keys("N/m^1.5", "ball",
                     {{"grooves", list_of(2, number().between(0.5, 1)), otherwise("[0.52, 0.52]"),
                       "Radius of the grooves of the inner and the outer ring, in diameters of a ball; above 0.5."},
                      {"young",
                       {modulus, list_of(2, modulus)},
                       otherwise("2.07e11"),
                       "Young's modulus of rings and balls, or of each."},
                      {"poisson", {ratio, list_of(2, ratio)}, otherwise("0.3"), "Poisson's ratio likewise."}})};
  }();
  return table;
}

void read_ball_bearing(const std::string& name, const YamlValue& entry, Model& model) {
  RollingGeometry geometry = read_geometry(entry, true);
  const double D = entry.at("ball_diameter").number();
  const YamlValue given = entry.at("grooves");
  const Vector2 grooves = read_numbers(given, 2, "two radii, of the inner and the outer groove");
  if (!(grooves.minCoeff() > 0.5)) given.fail("a groove is wider than the ball: expected more than 0.5");
  geometry.groove_distance = (grooves.sum() - 1) * D;
  geometry.contact_radius += (grooves[0] - 0.5) * D * std::cos(geometry.contact_angle);
  const auto of_both = [&](const char* key) {
    const YamlValue value = entry.at(key);
    return value.is_sequence() ? Vector2(read_numbers(value, 2, "two numbers, of rings and balls"))
                               : Vector2(Vector2::Constant(value.number()));
  };
  const Vector2 E = of_both("young"), nu = of_both("poisson");
  const double modulus = 2 / ((1 - nu[0] * nu[0]) / E[0] + (1 - nu[1] * nu[1]) / E[1]);
  const auto constant = entry.find("constant");
  if (constant)
    for (const char* key : {"young", "poisson"})
      if (entry.has(key)) entry.at(key).fail("the force follows from `constant`: give one of them");
  geometry.constant = constant ? constant->number() : constant_of_ball(geometry, D, grooves, modulus);
  add_rolling_bearing("ball_bearing", name, entry, geometry, model);
}

const KeyTable& roller_bearing_keys() {
  using namespace keys;
  static const KeyTable table{
      "a roller_bearing", "A cylindrical or tapered roller bearing, by the contacts of its rollers.",
      rolling_keys("N/m^(10/9)", "roller",
                   {{"roller_length", number("m").positive(), required,
                     "Length of contact of a roller. Steel rollers follow from it, by Palmgren's formula."}})};
  return table;
}

void read_roller_bearing(const std::string& name, const YamlValue& entry, Model& model) {
  RollingGeometry geometry = read_geometry(entry, false);
  geometry.roller_length = entry.at("roller_length").number();
  // Palmgren, steel: 3.84e-5 mm (Q/N)^0.9/(l/mm)^0.8 at each of both contacts.
  const double flexibility = 2 * 3.84e-8 / std::pow(geometry.roller_length / 1e-3, 0.8);
  const auto constant = entry.find("constant");
  geometry.constant = constant ? constant->number() : std::pow(flexibility, -1 / 0.9);
  add_rolling_bearing("roller_bearing", name, entry, geometry, model);
}

}  // namespace bielle::mechanism
