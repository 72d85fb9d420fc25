#include "mechanism/joints/pairs/guided_point.hpp"

#include "mechanism/joints/pairs/lower_pairs.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"

namespace bielle::mechanism {
namespace {

using CoordinateKind = JointCoordinate::Kind;

void read_guided_point(const std::string& type, const std::string& axis_key, const std::string& name,
                       const YamlValue& entry, Model& model, std::vector<JointCoordinate> coordinates,
                       const std::array<bool, 3>& locked) {
  check_pair_keys(entry, "a " + type + " joint", {"type", "nodes", "position", "at", axis_key, "second_axis"});
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::required, axis_key);
  add_pair(std::make_unique<LowerPair>(type, name, std::move(frames), std::move(coordinates),
                                       LockedMotions{locked, LockedMotions::Rotation::none}, model),
           entry, model);
}

}  // namespace

void read_point_on_line(const std::string& name, const YamlValue& entry, Model& model) {
  read_guided_point("point_on_line", "line", name, entry, model, {{"displacement", CoordinateKind::displacement, 2}},
                    {true, true, false});
}

void read_point_on_plane(const std::string& name, const YamlValue& entry, Model& model) {
  read_guided_point("point_on_plane", "normal", name, entry, model,
                    {{"x", CoordinateKind::displacement, 0}, {"y", CoordinateKind::displacement, 1}},
                    {false, false, true});
}

}  // namespace bielle::mechanism
