// Reader of `tyre`.
#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/pairs/wheel_place.hpp"
#include "mechanism/joints/tyres/tyre.hpp"
#include "mechanism/reading/read_file.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/table_file.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& tyre_slip_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const KeyForm length = number("m").positive();
    KeyForm shape = number().between(1, 2);
    shape.below = true;
    return KeyTable{
        "slip of a tyre",
        "Forces of a tyre along the road.",
        {{"longitudinal", number("N").positive(), required, "Force per longitudinal slip, at small slip."},
         {"lateral", number("N").positive(), required,
          "Force per lateral slip, the tangent of the slip angle, at small slip: the cornering stiffness."},
         {"friction", number().positive(), required, "Coefficient of friction: the largest force over the load."},
         {"relaxation",
          {length, list_of(2, length)},
          required,
          "Rolled length after which two thirds of the force have built up, or two, along and across. A slip "
          "stiffness divided by its length is the stiffness of the standing tyre."},
         {"damping", number("N s/m").non_negative(), computed("5 ms of the stiffness along"),
          "Damping of the standing tread along its way; across it is larger in the ratio of lateral to longitudinal. "
          "It "
          "fades while the tyre begins to roll, up to its `speed`."},
         {"trail", number("m").non_negative(), otherwise("0"),
          "Pneumatic trail at small slip: the lateral force acts so far behind the contact; a third of half the "
          "contact's length in the brush model."},
         {"camber", number("N").non_negative(), otherwise("0"), "Lateral force per sine of the camber angle."},
         {"stiffest_load", number("N").positive(), optional,
          "Load N_0 at which the slip stiffnesses are largest, as given; at a load N they are 2 w/(1 + w^2) of this, "
          "w = N/N_0. Without it they do not depend on the load."},
         {"shape", shape, optional,
          "Shape factor C of the magic formula, which falls beyond its peak. Without it the tyre is a brush model."},
         {"curvature", number().at_most(1), optional, "Curvature factor E of the magic formula; 0 by default."}}};
  }();
  return table;
}

const KeyTable& road_keys() {
  using namespace keys;
  static const KeyTable table{
      "a road",
      "A road whose height varies along its length.",
      {{"table", file("table of two columns"), required,
        "Distances from the point of the plane and heights above the plane [m]; a cubic spline joins them, and the "
        "road continues straight beyond them."},
       {"along", direction().as_vector().in_inertial_axes(), computed("axis x normal"),
        "Direction of the distances as drawn, made normal to `normal`."}}};
  return table;
}

TyreSlip read_tyre_slip(const YamlValue& entry) {
  TyreSlip slip;
  slip.stiffness = {entry.at("longitudinal").number(), entry.at("lateral").number()};
  const YamlValue relaxation = entry.at("relaxation");
  if (relaxation.is_sequence() && relaxation.size() != 2)
    relaxation.fail("expected a length, or two: along and across");
  slip.relaxation = relaxation.is_sequence() ? Eigen::Vector2d(relaxation.vector())
                                             : Eigen::Vector2d::Constant(relaxation.number()).eval();
  slip.friction = entry.at("friction").number();
  // It corresponds to a loss factor of 0.2, as rubber has, at 6 Hz, the frequency of cars on their standing tyres.
  constexpr double damping_time = 5e-3;
  const auto damping = entry.find("damping");
  slip.damping = damping ? damping->number() / slip.stiffness.x() : damping_time / slip.relaxation.x();
  slip.camber = entry.at("camber").number();
  slip.trail = entry.at("trail").number();
  if (const auto load = entry.find("stiffest_load")) slip.stiffest_load = load->number();
  if (const auto shape = entry.find("shape")) slip.shape = shape->number();
  if (const auto curvature = entry.find("curvature")) {
    if (!slip.shape) curvature->fail("is a factor of the magic formula, whose `shape` is missing");
    slip.curvature = curvature->number();
  }
  if (slip.shape) slip.peak = peak_of_formula(*slip.shape, slip.curvature);
  return slip;
}

ForceCurve read_radial_curve(const YamlValue& value) {
  return read_named_file(value, [](const std::string& path) {
    const MatrixX table = read_table(path, 2);
    ForceCurve curve = ForceCurve::from_file(path);
    if (curve(0).force != 0)
      throw InputError(fmt::format("{}: the force at zero deflection is {:.6g} N, expected 0", path, curve(0).force));
    for (Eigen::Index k = 0; k < table.rows(); ++k)
      if (table(k, 0) > 0 && (!(table(k, 1) > 0) || (k > 0 && table(k, 1) < table(k - 1, 1))))
        throw InputError(
            fmt::format("{}: the force of a tyre is positive and does not fall as the deflection grows; that of {:.6g} "
                        "N at {:.6g} m contradicts this",
                        path, table(k, 1), table(k, 0)));
    if (!(curve.last() > 0)) throw InputError(fmt::format("{}: expected deflections greater than 0", path));
    return curve;
  });
}

/// Reads the profile. The road's frame is moved to the point of the plane, and rotated by `along`.
std::shared_ptr<const RoadProfile> read_road(const YamlValue& road, const YamlValue& entry, double radius,
                                             const Model& model, JointFrames& frames) {
  const Frame& node = model.node(frames.first).frame;
  Frame drawn = node * frames.on_first;
  const Vector3 normal = drawn.R.col(2);
  if (const auto position = entry.find("position")) drawn.x = position->vector3();
  if (const auto at = entry.find("at")) drawn.x = node.x + node.R * read_points_at(*at)[0];
  if (const auto along = road.find("along")) {
    const Vector3 across = normal.cross(along->direction());
    if (across.norm() < flat_wheel) along->fail("the road runs along its plane, not along `normal`");
    drawn.R.col(1) = across.normalized();
    drawn.R.col(0) = drawn.R.col(1).cross(normal);
  }
  frames.on_first = inverse(node) * drawn;
  const YamlValue table = road.at("table");
  auto profile = read_named_file(
      table, [](const std::string& path) { return std::make_shared<RoadProfile>(read_table(path, 2), path); });
  if (const RoadProfile::Valley valley = profile->tightest_valley(); valley.radius <= radius)
    table.fail(
        fmt::format("at {:.6g} m the road has a valley of radius {:.4g} m, in which a tyre of radius {:.4g} m "
                    "touches at two points",
                    valley.x, valley.radius, radius));
  const Vector3 middle = drawn.R.transpose() * ((model.node(frames.second).frame * frames.on_second).x - drawn.x);
  if (!(middle.z() > (*profile)(middle.x()).height)) table.fail("the wheel is drawn below the road");
  return profile;
}

}  // namespace

const KeyTable& tyre_keys() {
  using namespace keys;
  static const KeyTable table{
      "a tyre", "A wheel of the second node with an elastic tyre on a road of the first.",
      joined({wheel_place_keys(),
              {{"stiffness", number("N/m").positive(), optional, "Radial stiffness."},
               {"curve", file("table of two columns"), optional,
                "Deflections [m] and radial forces [N], joined by straight lines, in place of `stiffness`."},
               {"damping", number("N s/m").non_negative(), otherwise("0"),
                "Radial damping; the tyre never pulls at the road."},
               {"rolling_resistance", number().non_negative(), otherwise("0"), "Force against rolling over the load."},
               {"slip", nested(tyre_slip_keys), optional, "Forces along the road; without it the tyre has none."},
               {"speed", number("m/s").positive(), otherwise("0.1"),
                "Rolling speed at which rolling resistance, trail and camber force begin to act and the damping of the "
                "tread "
                "ends."},
               {"road", nested(road_keys), optional, "Profile of the road; without it the road is a plane."}}})};
  return table;
}

void read_tyre(const std::string& name, const YamlValue& entry, Model& model) {
  JointFrames frames = read_wheel_place(entry, model);
  const double radius = entry.at("radius").number();
  SpringTyreLaw law;
  const auto stiffness = entry.find("stiffness"), curve = entry.find("curve");
  if (stiffness && curve) curve->fail("the tyre has a `stiffness` or a `curve`: give one of them");
  if (!stiffness && !curve) entry.fail("a tyre has a radial `stiffness`, or a `curve` in its place, which is missing");
  if (stiffness) law.stiffness = stiffness->number();
  if (curve) law.curve = read_radial_curve(*curve);
  law.damping = entry.at("damping").number();
  law.rolling_resistance = entry.at("rolling_resistance").number();
  law.speed = entry.at("speed").number();
  if (const auto slip = entry.find("slip")) law.slip = read_tyre_slip(*slip);
  std::shared_ptr<const RoadProfile> road;
  if (const auto given = entry.find("road")) road = read_road(*given, entry, radius, model, frames);
  model.add(std::make_unique<Tyre>(std::move(frames), name, radius, std::move(law), std::move(road), model),
            Entry{Section::joints, name});
}

}  // namespace bielle::mechanism
