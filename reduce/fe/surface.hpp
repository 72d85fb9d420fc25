// Integrals over surface groups: areas, centroids, and the loads that act on their nodes.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Integrals of the shape functions of the nodes of a surface (faces of order 1 or 2, which may be curved).
struct SurfaceIntegrals {
  std::vector<int> nodes;                                   ///< ascending; the columns below follow them
  double area = 0;                                          ///< [m^2]
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();       ///< area-weighted [m]
  Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();  ///< int r r^T dA about the centroid [m^4]
  Eigen::VectorXd weights;                                  ///< int N_a dA [m^2]
  Eigen::Matrix3Xd first_moments;                           ///< int N_a r dA, r from the centroid [m^3]
  Eigen::Matrix3Xd normals;  ///< int N_a n dA, n the normal of the faces as oriented in the mesh [m^2]
};

/// @throws InputError if the mesh has no such surface group (nearest name)
const Group& surface_group(const Mesh& mesh, const std::string& name);

/// @throws InputError if the mesh has no such surface group (nearest name) or its area is zero; the message names the
///         group, and the caller gives it a subject
SurfaceIntegrals integrate_surface(const Mesh& mesh, const std::string& group);

/// Forces on the nodes of a surface [N], one column per node of `surface.nodes`.
/// @param pressure  [Pa], pushing against the outward normal
Eigen::Matrix3Xd pressure_forces(const SurfaceIntegrals& surface, double pressure);
/// @param traction  force per area [Pa]
Eigen::Matrix3Xd traction_forces(const SurfaceIntegrals& surface, const Eigen::Vector3d& traction);
/// @param force  total [N], spread evenly over the area
Eigen::Matrix3Xd spread_force(const SurfaceIntegrals& surface, const Eigen::Vector3d& force);

}  // namespace bielle::reduce
