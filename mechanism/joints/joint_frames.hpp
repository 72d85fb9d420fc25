// Where a joint stands on its two nodes.
//
//   position      one place (inertial, as drawn), fixed on both nodes; default: where the second node is drawn
//   at            a point in the axes of each node, in place of `position`: the start brings the two together
//   axis          z of the joint's frame: an inertial direction as drawn, fixed on both nodes; or a pair, one direction
//   in
//                 the axes of each node
//   second_axis   x of the frame (made orthogonal), given in either way. Without it x is the inertial axis most normal
//   to z,
//                 as drawn; where the two z differ as drawn, the second node's x follows by the smallest turn between
//                 them
//
// A joint without axis has frames parallel to the inertial axes as drawn.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Frames of a joint on its two nodes, in the nodes' axes. Coordinates are zero where they coincide.
struct JointFrames {
  int first = 0, second = 0;  ///< nodes of the model
  Frame on_first, on_second;
  /// Distance of the nodes as drawn, where the file does not say where the joint is: an arm of the first node bridges
  /// it [m]. 0 where it does.
  double arm = 0;
};

/// Whether a type needs an axis.
enum class AxisNeed { required, optional };

/// Reads `nodes`, `position` or `at`, `axis`, `second_axis` of a joint's entry.
/// @param axis_key  in place of `axis`, where the type calls it otherwise (`normal` of a plane)
/// @throws InputError
JointFrames read_joint_frames(const YamlValue& entry, const Model& model, AxisNeed need,
                              const std::string& axis_key = "axis");

/// The smallest rotation vector that turns one unit vector to another. @param normal  to both, where they are opposite
Vector3 smallest_turn(const Vector3& from, const Vector3& to, const Vector3& normal);

/// The keys that `read_joint_frames` reads, with `type`.
std::vector<std::string> joint_frame_keys();

/// `at` of a joint: a point in the axes of each node. @throws InputError where it is something else
std::array<Vector3, 2> read_points_at(const YamlValue& at);

}  // namespace bielle::mechanism
