// The place of a wheel on a plane of another node, which wheels and tyres share.
#pragma once

#include <vector>

#include "mechanism/joints/joint_frames.hpp"

namespace bielle::mechanism {

/// Sine of the angle between axis and normal below which a wheel lies flat.
inline constexpr double flat_wheel = 1e-3;

/// Returns the keys `type`, `nodes`, `position`, `at`, `normal`, `axis`, `radius`.
std::vector<Key> wheel_place_keys();

/// Reads these keys. J_A is in the plane below the middle of the wheel, z along the normal, x along axis x normal; J_B
/// is in the middle of the wheel, z along its axis.
/// @throws InputError if the wheel lies flat on the plane or is below it
JointFrames read_wheel_place(const YamlValue& entry, const Model& model);

}  // namespace bielle::mechanism
