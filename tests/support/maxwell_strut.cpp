#include "tests/support/maxwell_strut.hpp"

namespace bielle::test {

using namespace mechanism;

MaxwellStrut::MaxwellStrut(std::string name, int node_a, int node_b, double stiffness, double relaxation,
                           double tension)
    : Component("maxwell_strut", std::move(name)),
      node_a_(node_a),
      node_b_(node_b),
      stiffness_(stiffness),
      relaxation_(relaxation),
      tension_(tension) {}

void MaxwellStrut::declare(Declaration& declaration) const {
  declaration.nodes = {node_a_, node_b_};
  declaration.first_order = {{"tension", "N", tension_}};
  declaration.stiffness = declaration.damping = true;
}

void MaxwellStrut::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  const Vector3 s = B.x - A.x, u = s.normalized();
  const double N = state.first_order()[0];
  r.segment<3>(0) -= N * u;
  r.segment<3>(6) += N * u;
  r[12] += state.first_order_rate()[0] + N / relaxation_ - stiffness_ * u.dot(B.v - A.v);
}

// With Q = (I - u u^T)/l and w = Q (v_B - v_A), columns x_A, x_B, N:
//   K = [ N Q, -N Q, -u;  -N Q, N Q, u;  k w^T, -k w^T, 1/tau ],   C = [ 0, 0, 0;  0, 0, 0;  k u^T, -k u^T, 1 ]
void MaxwellStrut::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  auto K = tangent.K.dense(), C = tangent.C.dense();
  const NodeState &A = state.node(0), &B = state.node(1);
  const Vector3 s = B.x - A.x, u = s.normalized();
  if (tangent.wants_K) {
    const Matrix3 Q = (Matrix3::Identity() - u * u.transpose()) / s.norm();
    const Vector3 w = Q * (B.v - A.v);
    for (const int row : {0, 6}) {
      for (const int column : {0, 6})
        K.block<3, 3>(row, column) += (row == column ? 1 : -1) * state.first_order()[0] * Q;
      K.block<3, 1>(row, 12) += (row == 6 ? 1 : -1) * u;
      K.block<1, 3>(12, row) -= (row == 6 ? 1 : -1) * stiffness_ * w.transpose();
    }
    K(12, 12) += 1 / relaxation_;
  }
  if (tangent.wants_C) {
    for (const int column : {0, 6}) C.block<1, 3>(12, column) -= (column == 6 ? 1 : -1) * stiffness_ * u.transpose();
    C(12, 12) += 1;
  }
}

void MaxwellStrut::add_energy(const LocalState& state, Energy& energy) const {
  const double N = state.first_order()[0];
  energy.elastic += N * N / (2 * stiffness_);
  energy.dissipation += N * N / (stiffness_ * relaxation_);
}

}  // namespace bielle::test
