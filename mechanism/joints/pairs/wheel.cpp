#include "mechanism/joints/pairs/wheel.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/joints/lift_off.hpp"
#include "mechanism/joints/pairs/material_velocity.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"
#include "mechanism/joints/pairs/tyre_force.hpp"
#include "mechanism/joints/pairs/wheel_place.hpp"
#include "mechanism/model/description.hpp"
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

}  // namespace

WheelJoint::WheelJoint(std::string name, JointFrames frames, double radius, bool rolls, const Model& model)
    : MeasuredRows("wheel", std::move(name), std::move(frames),
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

template <int order>
WheelJoint::Slip<order> WheelJoint::calc_slip(const LocalState& state) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const Frame &A = frames().on_first, &B = frames().on_second;
  // Components of z_B along J_A, and of z_A along J_B.
  const auto b_x = alignment<order>(0, 2, state), b_y = alignment<order>(1, 2, state);
  const auto n_x = alignment<order>(2, 0, state), n_y = alignment<order>(2, 1, state);
  const auto s = sqrt(square(b_x) + square(b_y));
  const PairMeasureOf<order> zero;
  const auto t = turned<order>(A.R, {b_y / s, -(b_x / s), zero}), l = turned<order>(A.R, {b_x / s, b_y / s, zero});
  auto arm = turned<order>(B.R, {-radius_ * (n_x / s), -radius_ * (n_y / s), zero});
  for (std::size_t k = 0; k < 3; ++k) arm[k] += B.x[static_cast<Eigen::Index>(k)];
  PairVector<order> middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k].value = B.x[static_cast<Eigen::Index>(k)];
  return {material_velocity<order>(first, second, t, arm), material_velocity<order>(first, second, l, arm),
          material_velocity<order>(first, second, t, middle)};
}

template WheelJoint::Slip<1> WheelJoint::calc_slip(const LocalState&) const;
template WheelJoint::Slip<2> WheelJoint::calc_slip(const LocalState&) const;

template <int order>
void WheelJoint::rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const {
  const auto squared = square(alignment<order>(0, 2, state)) + square(alignment<order>(1, 2, state));
  if (!(squared.value > flat_wheel * flat_wheel))
    throw ComputationError(fmt::format(
        "t = {:.6g} s: the wheel of joint '{}' lies flat on its plane, where it has no lowest point to roll on",
        state.time(), name()));
  rows[0] = radius_ * sqrt(squared) - position<order>(2, state);
  if (rows.size() == 1) return;
  const Slip<order> slip = calc_slip<order>(state);
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
  static const KeyTable table{"a wheel", "A thin wheel of the second node on a plane of the first.",
                              joined({wheel_place_keys(), {tyre_key()}, joint_action_keys(Moves::slides)})};
  return table;
}

void read_wheel(const std::string& name, const YamlValue& entry, Model& model) {
  JointFrames frames = read_wheel_place(entry, model);
  const std::optional<TyreLaw> law = read_tyre_law(entry);
  auto wheel = std::make_unique<WheelJoint>(name, std::move(frames), entry.at("radius").number(), !law, model);
  const WheelJoint& rolling = *wheel;
  add_pair(std::move(wheel), entry, model);
  if (law) model.add(std::make_unique<TyreForce>(name, rolling, *law), Entry{Section::joints, name});
}

void WheelJoint::draw(Drawing& drawing) const {
  drawing.add({.shape = "plane", .places = {{frames().first, frames().on_first}}});
  drawing.add({.shape = "tyre", .places = {{frames().second, frames().on_second}}, .values = {{"radius", radius_}}});
}

}  // namespace bielle::mechanism
