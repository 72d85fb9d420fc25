#include "mechanism/joints/pairs/wheel.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/joints/lift_off.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"
#include "mechanism/joints/pairs/tyre_force.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

std::vector<MeasuredPair::Row> wheel_rows(bool rolls) {
  std::vector<MeasuredPair::Row> rows = {{"normal", "N"}};
  if (rolls) {
    rows.push_back({"longitudinal", "N", ConstraintKind::nonholonomic});
    rows.push_back({"lateral", "N", ConstraintKind::nonholonomic});
  }
  return rows;
}

/// Sine of the angle between axis and normal below which a wheel lies flat.
constexpr double flat = 1e-3;

/// Three numbers that depend on the positions: components of an axis or of a lever arm.
using VectorJet = std::array<PairMeasure, 3>;

Vector3 value_of(const VectorJet& jet) { return {jet[0].value, jet[1].value, jet[2].value}; }

/// Multiplies a vector by constant axes.
VectorJet turned(const Matrix3& axes, const VectorJet& vector) {
  VectorJet result;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k) result[row] += axes(static_cast<int>(row), static_cast<int>(k)) * vector[k];
  return result;
}

/// Velocity of the material of node 2 at the arm c, relative to node 1's material at the same place, along the axis e:
/// the gradient of the position measure at the present e and c, and its change while they vary.
PairMeasure material_velocity(const NodeState& first, const NodeState& second, const VectorJet& e, const VectorJet& c) {
  const Vector3 e_hat = value_of(e), c_2 = value_of(c);
  PairMeasure w = measure_position(first, second, e_hat, Vector3::Zero(), c_2);
  const Matrix3 R_12 = first.R.transpose() * second.R;
  const PointPair points(first, second, R_12, c_2);
  const Vector3 e_2 = R_12.transpose() * e_hat;
  for (int k = 0; k < 3; ++k) {
    const Vector3 unit = Vector3::Unit(k);
    w.second += points.gradient(unit) * e[static_cast<std::size_t>(k)].gradient.transpose();
    Vector12 by_arm = Vector12::Zero();
    by_arm.segment<3>(3) = e_hat.cross(R_12 * unit);
    by_arm.segment<3>(9) = unit.cross(e_2);
    w.second += by_arm * c[static_cast<std::size_t>(k)].gradient.transpose();
  }
  w.value = w.rate(pair_rate(first, second));
  return w;
}

}  // namespace

WheelJoint::WheelJoint(std::string name, JointFrames frames, double radius, bool rolls, const Model& model)
    : MeasuredPair("wheel", std::move(name), std::move(frames),
                   {{"x", JointCoordinate::Kind::displacement, 0}, {"y", JointCoordinate::Kind::displacement, 1}},
                   wheel_rows(rolls), model),
      radius_(radius) {}

void WheelJoint::declare(Declaration& declaration) const {
  MeasuredPair::declare(declaration);
  declaration.event_functions = {lift_off()};
}

void WheelJoint::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values[0] = state.reaction()[0];
}

WheelJoint::Slip WheelJoint::calc_slip(const LocalState& state) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const Frame &A = frames().on_first, &B = frames().on_second;
  // Components of z_B along J_A, and of z_A along J_B.
  const PairMeasure b_x = alignment(0, 2, state), b_y = alignment(1, 2, state);
  const PairMeasure n_x = alignment(2, 0, state), n_y = alignment(2, 1, state);
  const PairMeasure s = sqrt(square(b_x) + square(b_y));
  const PairMeasure zero;
  const VectorJet t = turned(A.R, {b_y / s, -(b_x / s), zero}), l = turned(A.R, {b_x / s, b_y / s, zero});
  VectorJet arm = turned(B.R, {-radius_ * (n_x / s), -radius_ * (n_y / s), zero});
  for (std::size_t k = 0; k < 3; ++k) arm[k] += B.x[static_cast<Eigen::Index>(k)];
  VectorJet middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k].value = B.x[static_cast<Eigen::Index>(k)];
  return {material_velocity(first, second, t, arm), material_velocity(first, second, l, arm),
          material_velocity(first, second, t, middle)};
}

void WheelJoint::calc_rows(const LocalState& state, std::span<PairMeasure> rows) const {
  const PairMeasure squared = square(alignment(0, 2, state)) + square(alignment(1, 2, state));
  if (!(squared.value > flat * flat))
    throw ComputationError(fmt::format(
        "t = {:.6g} s: the wheel of joint '{}' lies flat on its plane, where it has no lowest point to roll on",
        state.time(), name()));
  rows[0] = radius_ * sqrt(squared) - position(2, state);
  if (rows.size() == 1) return;
  const Slip slip = calc_slip(state);
  rows[1] = slip.longitudinal;
  rows[2] = slip.lateral;
}

void WheelJoint::describe(const LocalState& state, Description& description) const {
  MeasuredPair::describe(state, description);
  const Vector3 axis = state.node(1).R * frames().on_second.R.col(2);
  description.add(fmt::format("radius {:.6g} m, axis {}", radius_, format_vector(axis)));
}

const KeyTable& wheel_keys() {
  using namespace keys;
  static const KeyTable table{
      "a wheel", "A thin wheel of the second node on a plane of the first.",
      joined({{type_key(),
               {"nodes", list_of(2, name_of("node")), required, "Node of the plane and node of the wheel."},
               {"position", vector3("m").as_point().in_inertial_axes(), computed("the point below the rim as drawn"),
                "Point of the plane as drawn."},
               {"at", list_of(2, vector3("m").as_point()), optional,
                "Point of the plane and middle of the wheel, each in the axes of its node, in place of `position`."},
               {"normal", direction().as_vector().in_inertial_axes(), required,
                "Normal of the plane, towards the wheel, as drawn."},
               {"axis", direction().as_axial().in_inertial_axes(), required, "Axis of the wheel as drawn."},
               {"radius", number("m").positive(), required, "Radius of the wheel."},
               tyre_key()},
              joint_action_keys(Moves::slides)})};
  return table;
}

void read_wheel(const std::string& name, const YamlValue& entry, Model& model) {
  const std::vector<int> nodes = nodes_named_by(entry.at("nodes"), 2, model);
  if (nodes[0] == nodes[1]) entry.at("nodes").fail("a joint needs two different nodes");
  const Frame &plane_node = model.node(nodes[0]).frame, &hub = model.node(nodes[1]).frame;
  const Vector3 normal = entry.at("normal").direction(), axis = entry.at("axis").direction();
  const double radius = entry.at("radius").number();
  const double s = std::sqrt(std::max(0.0, 1 - std::pow(normal.dot(axis), 2)));
  if (s < flat) entry.at("axis").fail("the wheel lies flat on the plane: its axis is parallel to `normal`");
  // The point below the wheel's middle: at the distance given by the rim, or in the plane through `position` or the
  // first point of `at`.
  Vector3 middle = hub.x;
  double height = radius * s;
  if (const auto at = entry.find("at")) {
    if (entry.has("position"))
      at->fail("a wheel has a `position` of its plane or points `at` its nodes: give one of them");
    const auto [on_plane, on_hub] = read_points_at(*at);
    middle = hub.x + hub.R * on_hub;
    height = normal.dot(middle - plane_node.x - plane_node.R * on_plane);
  } else if (const auto position = entry.find("position")) {
    height = normal.dot(middle - position->vector3());
  }
  if (!(height > 0))
    entry.at(entry.has("at") ? "at" : "position")
        .fail("the wheel is drawn below the plane: `normal` points to the wheel");
  const auto frame_with = [](const Vector3& origin, const Vector3& z, const Vector3& x) {
    Frame frame;
    frame.x = origin;
    frame.R << x, z.cross(x), z;
    return frame;
  };
  const Vector3 way = axis.cross(normal).normalized();
  JointFrames frames;
  frames.first = nodes[0];
  frames.second = nodes[1];
  frames.on_first = inverse(plane_node) * frame_with(middle - height * normal, normal, way);
  frames.on_second = inverse(hub) * frame_with(middle, axis, way);
  const std::optional<TyreLaw> law = read_tyre_law(entry);
  auto wheel = std::make_unique<WheelJoint>(name, std::move(frames), radius, !law, model);
  const WheelJoint& rolling = *wheel;
  add_pair(std::move(wheel), entry, model);
  if (law) model.add(std::make_unique<TyreForce>(name, rolling, *law), Entry{Section::joints, name});
}

void WheelJoint::draw(Drawing& drawing) const {
  drawing.add({.shape = "plane", .places = {{frames().first, frames().on_first}}});
  drawing.add({.shape = "tyre", .places = {{frames().second, frames().on_second}}, .values = {{"radius", radius_}}});
}

}  // namespace bielle::mechanism
