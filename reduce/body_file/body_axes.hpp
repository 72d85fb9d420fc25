// Directions in a body file.
#pragma once

#include <Eigen/Core>

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

/// Returns the keys of `axes`.
const KeyTable& axes_keys();

/// `axes: {x: [..], y: [..]}`: a right-handed triad whose x axis has the direction x and whose xy plane contains y,
/// which is made normal to x.
/// @returns the rotation from the triad to the body: columns x, y, z
/// @throws InputError when a direction is missing or zero, or both are parallel
Eigen::Matrix3d read_axes(const YamlValue& value);

/// Rotation by a vector along its axis, whose length is the angle [rad].
Eigen::Matrix3d read_rotation_vector(const YamlValue& value);

/// Returns the triad of two directions. @param place  stands in the message @throws InputError when they are parallel
Eigen::Matrix3d triad(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const YamlValue& place);

}  // namespace bielle::reduce
