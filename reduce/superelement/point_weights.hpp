// How a point inside a mesh moves with the mesh nodes around it.
//
// Displacement and rotation are those, at the point, of the field that is linear in space and nearest to the
// displacements of the nodes around it, near ones counting most (at a node the displacement is the node's). The
// rotation is half the curl; where the nodes lie in one plane, it is that of the rigid motion nearest to them. Rigid
// motions are exact.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace bielle {

struct PointWeights {
  std::vector<Eigen::Index> nodes;  ///< of the mesh
  /// (6, 3 nodes): displacement and rotation of the point by the displacements x y z of the first node, the second ...
  Eigen::MatrixXd rows;
  /// (6, 3 nodes): strain xx yy zz yz xz xy there, engineering shears, of the linear field; zero where the nodes lie in
  /// one plane.
  Eigen::MatrixXd strains;
};

/// Distance of a point from the nearest of some nodes [m]; infinite without any.
double distance_from_mesh(const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& point);

/// @param nodes  of the mesh, body axes @param body  its name, for messages
/// @throws InputError when the point is away from the mesh
PointWeights point_weights(const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& point, const std::string& body);

}  // namespace bielle
