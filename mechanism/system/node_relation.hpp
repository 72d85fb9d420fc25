// The relations of one node's increments, rates and accelerations to the independent ones, see node_kinematics.hpp.
#pragma once

#include "mechanism/system/node_kinematics.hpp"

namespace bielle::mechanism {

using Matrix6X6 = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;  ///< has up to six columns, on the stack

struct NodeRelation {
  Matrix6X6 displacement;                  ///< A G
  Matrix6X6 displacement_step;             ///< A G T, with respect to increments since the base
  Matrix6X6 rate_of_displacement;          ///< V G T
  Matrix6X6 acceleration_of_displacement;  ///< W_z G T
  Matrix6X6 acceleration_of_rate;          ///< W_v G
  bool carried = false;                    ///< the last three are only set for carried nodes
};

/// Multiplies the columns of three free rotations of X by T(Dq); about a single axis T is the identity.
/// @param dq  increment since the base of the step; nullptr: zero
Matrix6X6 times_step_tangent(const Matrix6X6& X, const NodeFreedom& freedom, const VectorX* dq);

NodeRelation relate(const NodeKinematics& kinematics, int node, const State& state, const VectorX* dq);

}  // namespace bielle::mechanism
