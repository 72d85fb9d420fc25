#include "mechanism/joints/pairs/guided_point.hpp"

#include "mechanism/joints/pairs/lower_pairs.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"

namespace bielle::mechanism {
namespace {

using CoordinateKind = JointCoordinate::Kind;

void read_guided_point(const std::string& type, const std::string& axis_key, const std::string& name,
                       const YamlValue& entry, Model& model, std::vector<JointCoordinate> coordinates,
                       const std::array<bool, 3>& locked) {
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::required, axis_key);
  add_pair(std::make_unique<LowerPair>(type, name, std::move(frames), std::move(coordinates),
                                       LockedMotions{locked, LockedMotions::Rotation::none}, model),
           entry, model);
}

}  // namespace

const KeyTable& point_on_line_keys() {
  static const KeyTable table{
      "a point_on_line joint", "A joint that holds a point on a line and leaves turning free.",
      keys::joined({joint_frame_keys(AxisNeed::required, "line", AxisUse::sliding), joint_action_keys(Moves::slides)})};
  return table;
}

void read_point_on_line(const std::string& name, const YamlValue& entry, Model& model) {
  read_guided_point("point_on_line", "line", name, entry, model, {{"displacement", CoordinateKind::displacement, 2}},
                    {true, true, false});
}

const KeyTable& point_on_plane_keys() {
  static const KeyTable table{
      "a point_on_plane joint", "A joint that holds a point in a plane and leaves turning free.",
      keys::joined({joint_frame_keys(AxisNeed::required, "normal"), joint_action_keys(Moves::slides)})};
  return table;
}

void read_point_on_plane(const std::string& name, const YamlValue& entry, Model& model) {
  read_guided_point("point_on_plane", "normal", name, entry, model,
                    {{"x", CoordinateKind::displacement, 0}, {"y", CoordinateKind::displacement, 1}},
                    {false, false, true});
}

}  // namespace bielle::mechanism
