// Frames in input files: a position and one of several ways to give an orientation.
#pragma once

#include <string>
#include <vector>

#include "mechanism/math/se3.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the keys that give an orientation; at most one of them may be present.
///   rotation_vector: [rad x3]          axis times angle
///   quaternion: [w, x, y, z]           its length is arbitrary
///   bryant: [a, b, c]                  R = R_x(a) R_y(b) R_z(c) [rad]
///   euler: [a, b, c]                   R = R_z(a) R_x(b) R_z(c) [rad]
///   axes: {x: [..], y: [..]}           two of x, y, z; the second is made orthogonal to the first
///   matrix: [[..], [..], [..]]         R itself: columns are the own axes; made orthonormal if the error is below 1e-3
///   rodrigues: [..]                    tan(angle/2) times the axis
///   conformal: [..]                    4 tan(angle/4) times the axis (Wiener-Milenkovic)
const std::vector<Key>& orientation_keys();

/// Returns the keys of an orientation relative to the inertial axes.
const std::vector<Key>& inertial_orientation_keys();

/// Returns the rotation (own axes -> inertial axes) of an entry; identity if it has none of the keys.
/// @throws InputError if there are two, or one that gives no rotation
Matrix3 read_orientation(const YamlValue& entry);

/// Returns the keys of an inertial frame: `position` and those of an orientation.
std::vector<Key> frame_keys();
/// Returns the keys of a frame in the axes of a node.
std::vector<Key> own_frame_keys();

/// Reads `position` with an orientation, of a map that is bound to a table with `frame_keys`.
Frame read_frame(const YamlValue& entry);

}  // namespace bielle::mechanism
