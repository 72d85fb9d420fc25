// Measures of nodes: positions, velocities, rotations and angular velocities, distances and angles.
//
//   position.x       e . (p_2 - p_1), of a point of the node from a point of another, along an axis e fixed on the
//                    other; alone: from the inertial origin along inertial axes [m]
//   velocity.x       its rate, as seen in those axes [m/s]
//   rotation.x       component of the rotation vector (principal value) by which the node has turned from where it
//                    was drawn, relative to the other [rad]
//   angular_velocity.x   component of the angular velocity relative to the other along the same axis [rad/s]
//   turn.x           its turn about the axis, counted over turns, see turn_measure.hpp [rad]; turn.x.rate [rad/s]
//   bryant.a, ...    its orientation, see orientation_measures.hpp
//   distance(a, b)   [m];   angle(a, b)   of the rotation from a to b, 0 to pi [rad]
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/model/measure.hpp"
#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

enum class NodeQuantity { position, velocity, rotation, angular_velocity, turn, turn_rate };

/// A node relative to another.
struct NodePair {
  int first = 0, second = 0;           ///< first: reference node of the second; 0, the ground, for inertial axes
  Vector3 at_first = Vector3::Zero();  ///< points [m], each in the axes of its node
  Vector3 at_second = Vector3::Zero();
};

/// @param direction  axis e, a unit vector in the axes of the first node
std::unique_ptr<Measure> make_node_measure(const std::string& name, const Model& model, const NodePair& pair,
                                           NodeQuantity quantity, const Vector3& direction);
std::unique_ptr<Measure> make_distance(const std::string& name, const NodePair& pair);
std::unique_ptr<Measure> make_angle(const std::string& name, const NodePair& pair);

/// "position.x", "bryant.a", ...: what formulas may use of every node, along inertial axes.
const std::vector<std::string>& node_measure_names();
/// Creates one of these measures of a node.
std::unique_ptr<Measure> make_node_measure(const std::string& name, const Model& model, int node,
                                           const std::string& measure);

}  // namespace bielle::mechanism
