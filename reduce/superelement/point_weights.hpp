// The motion of a point inside a mesh in terms of the mesh nodes around it.
//
// Displacement and rotation at the point are those of the field that is linear in space and nearest to the
// displacements of the surrounding nodes, with the largest weights for near nodes (at a node the displacement is the
// node's). The rotation is half the curl; if the nodes lie in one plane, it is that of the rigid motion nearest to
// them. Rigid motions are exact.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace bielle {

struct PointWeights {
  std::vector<Eigen::Index> nodes;  ///< mesh nodes
  Eigen::VectorXd weights;          ///< weight of each node in the fit, the largest for the nearest
  /// (6, 3 nodes): maps the displacements x y z of the first node, the second ... to displacement and rotation of the
  /// point.
  Eigen::MatrixXd rows;
  /// (6, 3 nodes): strain xx yy zz yz xz xy of the linear field there, engineering shears; zero if the nodes lie in one
  /// plane.
  Eigen::MatrixXd strains;
};

/// Distance of a point from the nearest of some nodes [m]; infinite if there are none.
double distance_from_mesh(const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& point);

/// @param nodes  mesh nodes, body axes @param body  its name, for messages
/// @throws InputError when the point is away from the mesh
PointWeights point_weights(const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& point, const std::string& body);

}  // namespace bielle
