#include "mechanism/system/node_relation.hpp"

namespace bielle::mechanism {

Matrix6X6 times_step_tangent(const Matrix6X6& X, const NodeFreedom& f, const VectorX* dq) {
  Matrix6X6 Y = X;
  if (dq && f.rotations == 3) Y.rightCols<3>() = X.rightCols<3>() * tangent(dq->segment<3>(f.begin + f.count - 3));
  return Y;
}

NodeRelation relate(const NodeKinematics& kinematics, int node, const State& state, const VectorX* dq) {
  NodeRelation relation;
  const Carry* carry = kinematics.carry(node);
  const NodeFreedom& f = kinematics.freedom(carry ? carry->carrier : node);
  const Matrix6X6 G = f.G.leftCols(f.count);
  const Matrix6X6 GT = times_step_tangent(G, f, dq);
  if (!carry) {
    relation.displacement = G;
    relation.displacement_step = GT;
    return relation;
  }
  relation.carried = true;
  const NodeState& i = state.nodes[static_cast<std::size_t>(carry->carrier)];
  const Vector3 arm_rate = i.Omega.cross(carry->c);
  Matrix6 A = Matrix6::Zero(), V = Matrix6::Zero(), W_z = Matrix6::Zero(), W_v = Matrix6::Zero();
  A.topLeftCorner<3, 3>().setIdentity();
  A.topRightCorner<3, 3>() = -i.R * skew(carry->c);
  A.bottomRightCorner<3, 3>() = carry->R_c.transpose();
  V.topRightCorner<3, 3>() = -i.R * skew(arm_rate);
  W_v.topRightCorner<3, 3>() = -i.R * (skew(arm_rate) + skew(i.Omega) * skew(carry->c));
  W_z.topRightCorner<3, 3>() = -i.R * skew(i.Omegadot.cross(carry->c) + i.Omega.cross(arm_rate));
  relation.displacement = A * G;
  relation.displacement_step = A * GT;
  relation.rate_of_displacement = V * GT;
  relation.acceleration_of_displacement = W_z * GT;
  relation.acceleration_of_rate = W_v * G;
  return relation;
}

}  // namespace bielle::mechanism
