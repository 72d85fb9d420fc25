#include "mechanism/measures/pair_rotation.hpp"

namespace bielle::mechanism {
namespace {

// First local rows of the nodes' rotations.
constexpr int turn_1 = 3, turn_2 = 9;

}  // namespace

PairRotation::PairRotation(const NodeState& first, const NodeState& second, const Matrix3& A, const Matrix3& B)
    : A_(A), R_12_(first.R.transpose() * second.R), psi_(log_so3(Matrix3(A.transpose() * R_12_ * B))) {}

Vector3 PairRotation::omega(const NodeState& first, const NodeState& second) const {
  return A_.transpose() * (R_12_ * second.Omega - first.Omega);
}

PairRotation::Gradients PairRotation::rate_gradients() const {
  Gradients J = Gradients::Zero();
  J.middleCols<3>(turn_1) = -A_.transpose();
  J.middleCols<3>(turn_2) = A_.transpose() * R_12_;
  return J;
}

PairRotation::Gradients PairRotation::gradients() const { return tangent_inverse(psi_).transpose() * rate_gradients(); }

//   J^T c = [-a; R_12^T a],  a = A c in node 1's axes;   d(J^T c) at fixed c: only in the rows of dTheta_2,
//   d(R_12^T a) = (R_12^T a)~ dTheta_2 - R_12^T a~ dTheta_1
void PairRotation::add_rate_second(const Vector3& c, Matrix12& W) const {
  const Vector3 a = A_ * c, a_2 = R_12_.transpose() * a;
  W.block<3, 3>(turn_2, turn_1) -= R_12_.transpose() * skew(a);
  W.block<3, 3>(turn_2, turn_2) += skew(a_2);
}

//   g = J^T T^-1 c,   dg = d(J^T) T^-1 c + J^T D(T^-1 c)[dpsi],   dpsi = T^-T J dz
void PairRotation::add_second(const Vector3& c, Matrix12& S) const {
  const Matrix3 T_inverse = tangent_inverse(psi_);
  add_rate_second(T_inverse * c, S);
  Matrix3 by_psi;  // D(T^-1 c)
  for (int k = 0; k < 3; ++k) by_psi.col(k) = tangent_inverse_derivative(psi_, Vector3::Unit(k)) * c;
  const Matrix3 bend = by_psi * T_inverse.transpose();
  const Matrix3 J_1 = -A_.transpose(), J_2 = A_.transpose() * R_12_;
  const Matrix3 bend_1 = bend * J_1, bend_2 = bend * J_2;
  S.block<3, 3>(turn_1, turn_1) += J_1.transpose() * bend_1;
  S.block<3, 3>(turn_1, turn_2) += J_1.transpose() * bend_2;
  S.block<3, 3>(turn_2, turn_1) += J_2.transpose() * bend_1;
  S.block<3, 3>(turn_2, turn_2) += J_2.transpose() * bend_2;
}

void PairRotation::calc(int axis, const NodeState& first, const NodeState& second, CoordinateDerivatives& jet) const {
  calc_slopes(axis, first, second, jet);
  const Vector3 e = Vector3::Unit(axis);
  Matrix12 S = Matrix12::Zero(), W = Matrix12::Zero();
  add_second(e, S);
  add_rate_second(e, W);
  jet.S().topLeftCorner<12, 12>() = S;
  jet.W().topLeftCorner<12, 12>() = W;
}

void PairRotation::calc_slopes(int axis, const NodeState& first, const NodeState& second,
                               CoordinateSlopes& slopes) const {
  slopes.value = slopes.principal = psi_[axis];
  slopes.rate = omega(first, second)[axis];
  slopes.w().head<12>() = rate_gradients().row(axis).transpose();
  slopes.g().head<12>() = gradients().row(axis).transpose();
}

}  // namespace bielle::mechanism
