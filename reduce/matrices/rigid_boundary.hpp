// Rigid motions of the interfaces of foreign matrices: they cause no forces, and move all points rigidly.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reduce/matrices/node_interfaces.hpp"
#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

/// Returns K~ of the kept directions without the forces of rigid motions, which come from the few digits of a text
/// file.
/// @param condensed  (b,b) as computed
/// @throws InputError if these forces are more than that: the matrices are held to the ground, or do not belong to the
///         positions of the nodes
Eigen::MatrixXd boundary_stiffness(const MatrixSet& set, const NodeTies& ties, const Eigen::MatrixXd& condensed,
                                   const MassProperties& body);

/// Returns displacements (3p,N) with exact rigid motions: those of the interface columns are replaced by the geometric
/// ones.
void put_exact_rigid_motions(const std::vector<Interface>& interfaces, const MassProperties& body,
                             const Eigen::Matrix3Xd& points, Eigen::MatrixXd& displacement);

}  // namespace bielle::reduce
