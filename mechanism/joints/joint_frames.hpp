// Position and axes of a joint on its two nodes.
//
//   position      one point (inertial, initial), fixed on both nodes; default: initial position of the second node
//   at            a point in the axes of each node, instead of `position`: the assembly makes the two coincide
//   axis          z of the joint's frame: an initial inertial direction, fixed on both nodes; or a pair, one direction
//   in
//                 the axes of each node
//   second_axis   x of the frame (made orthogonal), given in either way. By default x is the inertial axis most normal
//   to z,
//                 initially; if the two z differ, the second node's x follows by the smallest rotation between
//                 them
//
// A joint without axis has frames that are initially parallel to the inertial axes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Frames of a joint on its two nodes, in the nodes' axes. Coordinates are zero if the frames coincide.
struct JointFrames {
  int first = 0, second = 0;  ///< node indices in the model
  Frame on_first, on_second;
  /// Initial distance of the nodes if the file does not give the position of the joint: a lever arm of the first node
  /// bridges it [m]. It is 0 if the file does, or if the first node is the ground.
  double arm = 0;
};

/// Whether a type needs an axis.
enum class AxisNeed { required, optional };

/// Type of motion that the axis describes, along it or about it, which determines its sign in a mirror image.
enum class AxisUse { turning, sliding };

/// Reads the frames of a joint's entry.
/// @param axis_key  key instead of `axis`, if the type has another name for it (`normal` of a plane)
/// @throws InputError
JointFrames read_joint_frames(const YamlValue& entry, const Model& model, AxisNeed need,
                              const std::string& axis_key = "axis");

/// Returns the smallest rotation vector that rotates one unit vector to another. @param normal  normal to both, used if
/// they are opposite
Vector3 smallest_turn(const Vector3& from, const Vector3& to, const Vector3& normal);

/// Returns `type` and the keys that `read_joint_frames` reads. @param axis_key  as read_joint_frames
std::vector<Key> joint_frame_keys(AxisNeed need, const std::string& axis_key = "axis", AxisUse use = AxisUse::turning);
/// Returns the keys among them that give the place: `type`, `nodes`, `position`, `at`.
std::vector<Key> joint_place_keys();

/// Reads `at` of a joint: a point in the axes of each node. @throws InputError if the value has another form
std::array<Vector3, 2> read_points_at(const YamlValue& at);

}  // namespace bielle::mechanism
