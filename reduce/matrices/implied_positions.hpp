// Positions and axes of nodes as the rigid motions of a stiffness imply them.
//
// The six static rigid motions U span the same motions as translations T and rotations R. In a translation all nodes
// move alike: U c = T gives c for each direction by least squares. Rotations have unit rotations of the nodes, if nodes
// have rotations; otherwise displacements u_a = C x_a + t with an antisymmetric C, which leaves their scale unknown.
// The position of a node relative to the others is then that of u_a = theta x x_a. Weights that fall with the residual
// of a node keep a few wrong nodes from disturbing the others.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/matrices/matrix_study.hpp"

namespace bielle::reduce {

struct ImpliedPositions {
  std::vector<Eigen::Index> nodes;  ///< those with all three displacements
  Eigen::Matrix3Xd positions;       ///< (3,nodes) relative to an unknown origin [m]
  Eigen::VectorXd turns;            ///< (nodes) angle between the node's axes and those in which it moves [rad]
  bool has_scale = false;           ///< whether lengths are known, since nodes have rotations
};

/// @param motions  (n,6) independent motions without force
/// @returns nothing if fewer than two nodes have all displacements, or without rotations fewer than four
std::optional<ImpliedPositions> implied_positions(const MatrixStudy& study, const Eigen::MatrixXd& motions);

/// The similarity x -> f Q x + o that maps points to others best; a minority of the points may disagree.
struct Similarity {
  double factor = 1;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::VectorXd distances;  ///< distance of each point from its image [m]
};

/// Returns the translation alone: the median of the differences.
Similarity nearest_translation(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);
/// Horn's quaternion, B. K. P. Horn, J. Opt. Soc. Am. A 4 (1987) 629, with weights.
Similarity nearest_similarity(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace bielle::reduce
