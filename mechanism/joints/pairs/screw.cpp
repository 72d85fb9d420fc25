#include "mechanism/joints/pairs/screw.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/pairs/read_pair.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {
namespace {
constexpr std::size_t screw_angle = 1;  ///< index of the angle
}

ScrewJoint::ScrewJoint(std::string name, JointFrames frames, double pitch, const Model& model)
    : MeasuredRows(
          "screw", std::move(name), std::move(frames),
          {{"displacement", JointCoordinate::Kind::displacement, 2}, {"angle", JointCoordinate::Kind::angle, 2}},
          {{"x", "N"}, {"y", "N"}, {"rx", "N m"}, {"ry", "N m"}, {"thread", "N"}}, model),
      pitch_(pitch) {}

template <int order>
void ScrewJoint::rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const {
  rows[0] = position<order>(0, state);
  rows[1] = position<order>(1, state);
  rows[2] = alignment<order>(1, 2, state);
  rows[3] = alignment<order>(0, 2, state);
  auto angle = measure_angle<order>(state.node(0), state.node(1), frames().on_first.R, frames().on_second.R);
  angle.value = coordinate(screw_angle, state).value;  // this value includes the turns
  rows[4] = position<order>(2, state) - (pitch_ / (2 * M_PI)) * angle;
}

void ScrewJoint::start_at(std::size_t coordinate, double value, bool by_motion) {
  MeasuredPair::start_at(coordinate, value, by_motion);
  // The start value of the displacement determines the number of turns.
  if (coordinate != screw_angle) MeasuredPair::start_at(screw_angle, 2 * M_PI * value / pitch_, by_motion);
}

std::vector<SlidingSurface> ScrewJoint::sliding_surfaces() const { return {{{0, screw_angle}, pitch_ / (2 * M_PI)}}; }

std::string ScrewJoint::wrong_branch(const LocalState& state) const {
  const Vector3 first = state.node(0).R * frames().on_first.R.col(2),
                second = state.node(1).R * frames().on_second.R.col(2);
  return first.dot(second) < 0 ? "its axes point in opposite directions" : "";
}

Vector3 ScrewJoint::misalignment(const LocalState& state) const {
  const Matrix3 first = state.node(0).R * frames().on_first.R, second = state.node(1).R * frames().on_second.R;
  return smallest_turn(second.col(2), first.col(2), first.col(0));
}

void ScrewJoint::describe(const LocalState& state, Description& description) const {
  MeasuredPair::describe(state, description);
  description.add(fmt::format("{:.6g} m per turn", pitch_));
}

const KeyTable& screw_keys() {
  using namespace keys;
  static const KeyTable table{
      "a screw", "A joint that slides along its axis as it turns about it.",
      joined({joint_frame_keys(AxisNeed::required),
              {{"pitch", number("m"), required, "Displacement along the axis per turn; positive if right-handed."}},
              joint_action_keys(Moves::both)})};
  return table;
}

void read_screw(const std::string& name, const YamlValue& entry, Model& model) {
  const double pitch = entry.at("pitch").number();
  if (pitch == 0) entry.at("pitch").fail("a screw without pitch does not move along its axis: take a hinge");
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::required);
  add_pair(std::make_unique<ScrewJoint>(name, std::move(frames), pitch, model), entry, model);
}

}  // namespace bielle::mechanism
