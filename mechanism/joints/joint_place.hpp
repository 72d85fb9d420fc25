// Position of a joint whose axes are read by its own type.
#pragma once

#include "mechanism/joints/joint_frames.hpp"

namespace bielle::mechanism {

/// Reads `nodes` and `position` or `at` alone. @returns frames that are initially parallel to the inertial axes
/// @throws InputError as `read_joint_frames`
JointFrames read_joint_place(const YamlValue& entry, const Model& model);

}  // namespace bielle::mechanism
