#include "tests/support/series_strut.hpp"

#include <cmath>

namespace bielle::test {

using namespace mechanism;

double SeriesStrut::Law::solve(double l, double rate) const {
  // The function is monotonous and convex on either side of zero: Newton's method converges from any start.
  double y = 0;
  for (int k = 0; k < 100; ++k) {
    const double step = (force(y) - k_2 * (l - l_0 - y) - d * rate) / (stiffness(y) + k_2);
    y -= step;
    if (std::abs(step) <= 1e-15 * std::abs(y)) break;
  }
  return y;
}

SeriesStrut::SeriesStrut(std::string name, int node_a, int node_b, const Law& law, bool eliminated, double start)
    : Component("series_strut", std::move(name)),
      node_a_(node_a),
      node_b_(node_b),
      law_(law),
      eliminated_(eliminated),
      start_(start) {}

void SeriesStrut::declare(Declaration& declaration) const {
  declaration.nodes = {node_a_, node_b_};
  if (!eliminated_) declaration.first_order = {{"elongation", "m", start_, ConstraintKind::holonomic, 1e-2, "N", true}};
  declaration.stiffness = declaration.damping = true;
}

void SeriesStrut::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  const Vector3 s = B.x - A.x, u = s.normalized();
  const double l = s.norm(), rate = u.dot(B.v - A.v);
  const double y = eliminated_ ? law_.solve(l, rate) : state.first_order()[0], N = law_.force(y);
  r.segment<3>(0) -= N * u;
  r.segment<3>(6) += N * u;
  if (!eliminated_) r[12] += N - law_.k_2 * (l - law_.l_0 - y) - law_.d * rate;
}

// With Q = (I - u u^T)/l and w = Q (v_B - v_A), by the relative position, relative velocity and y:
//   N u:  N Q,  0,  N' u;    f:  -(k_2 u + d w)^T,  -d u^T,  N' + k_2
void SeriesStrut::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  auto K = tangent.K.dense(), C = tangent.C.dense();
  const NodeState &A = state.node(0), &B = state.node(1);
  const Vector3 s = B.x - A.x, u = s.normalized();
  const double l = s.norm(), rate = u.dot(B.v - A.v);
  const double y = eliminated_ ? law_.solve(l, rate) : state.first_order()[0];
  const double N_y = law_.stiffness(y), f_y = N_y + law_.k_2;
  const Matrix3 Q = (Matrix3::Identity() - u * u.transpose()) / l;
  const Vector3 f_x = -(law_.k_2 * u + law_.d * (Q * (B.v - A.v))), f_v = -law_.d * u;
  for (const int column : {0, 6}) {
    const double sign = column == 6 ? 1 : -1;
    if (!eliminated_ && tangent.wants_K) K.block<1, 3>(12, column) += sign * f_x.transpose();
    if (!eliminated_ && tangent.wants_C) C.block<1, 3>(12, column) += sign * f_v.transpose();
    for (const int row : {0, 6}) {
      const double both = row == column ? 1 : -1;
      if (tangent.wants_K) K.block<3, 3>(row, column) += both * law_.force(y) * Q;
      if (!eliminated_) continue;
      if (tangent.wants_K) K.block<3, 3>(row, column) -= both * N_y / f_y * u * f_x.transpose();
      if (tangent.wants_C) C.block<3, 3>(row, column) -= both * N_y / f_y * u * f_v.transpose();
    }
  }
  if (eliminated_ || !tangent.wants_K) return;
  K.block<3, 1>(0, 12) -= N_y * u;
  K.block<3, 1>(6, 12) += N_y * u;
  K(12, 12) += f_y;
}

}  // namespace bielle::test
