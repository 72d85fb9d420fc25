#include "mechanism/joints/pairs/universal.hpp"

#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "mechanism/joints/joint_place.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"
#include "mechanism/math/axes_along.hpp"

namespace bielle::mechanism {
namespace {

using CoordinateKind = JointCoordinate::Kind;
constexpr int x = 0, y = 1, z = 2;  ///< indices of axes of the frames

/// Returns the rows of a common point, and one further row.
std::vector<MeasuredPair::Row> point_and(const char* torque) {
  return {{"x", "N"}, {"y", "N"}, {"z", "N"}, {torque, "N m"}};
}

}  // namespace

UniversalJoint::UniversalJoint(std::string name, JointFrames frames, const Model& model)
    : MeasuredRows("universal", std::move(name), std::move(frames),
                   {{"angle_1", CoordinateKind::angle, JointCoordinate::by_type},
                    {"angle_2", CoordinateKind::angle, JointCoordinate::by_type}},
                   point_and("cross"), model) {}

void UniversalJoint::declare(Declaration& declaration) const {
  MeasuredPair::declare(declaration);
  for (const char* shaft : {"angle_1", "angle_2"}) {
    EventFunction singular{
        fmt::format("{} passes a right angle, where a shaft drawn straight transmits no torque", shaft)};
    singular.restarts = false;
    declaration.event_functions.push_back(singular);
  }
}

void UniversalJoint::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  for (std::size_t k : {0U, 1U}) values[static_cast<Eigen::Index>(k)] = std::cos(own_angle<1>(k, state).value);
}

template <int order>
void UniversalJoint::rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const {
  for (const int axis : {x, y, z}) rows[static_cast<std::size_t>(axis)] = position<order>(axis, state);
  rows[3] = alignment<order>(z, x, state);
}

template <int order>
PairMeasureOf<order> UniversalJoint::own_angle(std::size_t index, const LocalState& state) const {
  return index == 0 ? atan2(alignment<order>(y, x, state), alignment<order>(x, x, state))
                    : atan2(alignment<order>(z, y, state), alignment<order>(z, z, state));
}

PairMeasure UniversalJoint::calc_own_coordinate(std::size_t index, const LocalState& state) const {
  return own_angle<2>(index, state);
}

PairSlope UniversalJoint::calc_own_slope(std::size_t index, const LocalState& state) const {
  return own_angle<1>(index, state);
}

ConstantVelocityJoint::ConstantVelocityJoint(std::string name, JointFrames frames, const Model& model)
    : MeasuredRows("constant_velocity", std::move(name), std::move(frames),
                   {{"bend_x", CoordinateKind::rotation, x}, {"bend_y", CoordinateKind::rotation, y}},
                   point_and("torque"), model) {}

template <int order>
void ConstantVelocityJoint::rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const {
  for (const int axis : {x, y, z}) rows[static_cast<std::size_t>(axis)] = position<order>(axis, state);
  rows[3] = 0.5 * (alignment<order>(y, x, state) - alignment<order>(x, y, state));
}

std::string ConstantVelocityJoint::wrong_branch(const LocalState& state) const {
  // Without twist x_A . x_B + y_A . y_B = 1 + cos(bend); after a rotation by half a turn about the axis it is -2.
  const Matrix3 A = state.node(0).R * frames().on_first.R, B = state.node(1).R * frames().on_second.R;
  if (A.col(x).dot(B.col(x)) + A.col(y).dot(B.col(y)) < 0)
    return "its shafts are turned by half a turn about their axis";
  if (A.col(z).dot(B.col(z)) < -1 + 1e-6) return "its shafts fold back onto each other";
  return {};
}

const KeyTable& universal_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const KeyForm axis = direction().as_axial();
    const KeyForms direction_or_pair = {axis.in_inertial_axes(), list_of(2, axis)};
    return KeyTable{"a universal joint", "A cross between two shafts, which turns about its two arms.",
                    joined({joint_place_keys(),
                            {{"axis", direction_or_pair, required,
                              "Arm of the cross that is fixed on the first node, as drawn; or a direction in the axes "
                              "of each node."},
                             {"second_axis", direction_or_pair, required,
                              "Arm of the cross that is fixed on the second node, at right angles to `axis`; or a "
                              "direction in the axes of each node."}},
                            joint_action_keys(Moves::turns)})};
  }();
  return table;
}

void read_universal(const std::string& name, const YamlValue& entry, Model& model) {
  const YamlValue second_axis = entry.at("second_axis"), axis = entry.at("axis");
  // Each direction of a pair is made orthogonal to the axis on its node.
  const auto is_pair = [](const YamlValue& value) {
    return value.is_sequence() && value.size() > 0 && value.at(std::size_t{0}).is_sequence();
  };
  if (!is_pair(axis) && !is_pair(second_axis) && std::abs(second_axis.direction().dot(axis.direction())) > 1e-6)
    second_axis.fail(
        "the two axes of the cross have to be at right angles; `axis` rides on the first node, "
        "`second_axis` on the second");
  add_pair(std::make_unique<UniversalJoint>(name, read_joint_frames(entry, model, AxisNeed::required), model), entry,
           model);
}

namespace {

/// Rotates the frames so that their z axes are the two initial shafts: the second by the bend between them.
/// @param second_axis  x of the first one, if it is given
void bend_frames(JointFrames& frames, const YamlValue& axes, const std::optional<YamlValue>& second_axis,
                 const Model& model) {
  if (!axes.is_sequence() || axes.size() != 2)
    axes.fail("expected two directions: of the first shaft and of the second");
  const Vector3 first = axes.at(0).direction(), second = axes.at(1).direction();
  if (first.dot(second) < -1 + 1e-6)
    axes.fail(
        "fold back onto each other: the joint bends by less than 180 degrees; give both from the first shaft to the "
        "second");
  Matrix3 straight = axes_along(first);
  if (second_axis) {
    const Vector3 given = second_axis->direction(), across = given - first * first.dot(given);
    if (across.norm() < 1e-6) second_axis->fail("is parallel to the first shaft");
    straight.col(0) = across.normalized();
    straight.col(1) = first.cross(straight.col(0));
  }
  const Matrix3 bend = Eigen::Quaterniond::FromTwoVectors(first, second).toRotationMatrix();
  frames.on_first.R = model.node(frames.first).frame.R.transpose() * straight;
  frames.on_second.R = model.node(frames.second).frame.R.transpose() * bend * straight;
}

}  // namespace

const KeyTable& constant_velocity_keys() {
  using namespace keys;
  static const KeyTable table{
      "a constant-velocity joint", "A joint between two shafts that turn at equal rates at any bend below 180 degrees.",
      joined({joint_frame_keys(AxisNeed::optional),
              {{"axes", list_of(2, direction().as_axial().in_inertial_axes()), optional,
                "Directions of the first and of the second shaft as drawn, in place of `axis`, of a joint that is "
                "drawn bent; `second_axis` is then one direction, across the first."}},
              joint_action_keys(Moves::turns)})};
  return table;
}

void read_constant_velocity(const std::string& name, const YamlValue& entry, Model& model) {
  const auto axes = entry.find("axes");
  if (axes)
    if (const auto too_much = entry.find("axis"))
      too_much->fail("a constant-velocity joint has either `axis` or `axes`");
  JointFrames frames = axes ? read_joint_place(entry, model) : read_joint_frames(entry, model, AxisNeed::required);
  if (axes) bend_frames(frames, *axes, entry.find("second_axis"), model);
  add_pair(std::make_unique<ConstantVelocityJoint>(name, std::move(frames), model), entry, model);
}

}  // namespace bielle::mechanism
