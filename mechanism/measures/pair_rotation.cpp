#include "mechanism/measures/pair_rotation.hpp"

namespace bielle::mechanism {

PairRotation::PairRotation(const NodeState& first, const NodeState& second, const Matrix3& A, const Matrix3& B)
    : A_(A), R_12_(first.R.transpose() * second.R), psi_(log_so3(Matrix3(A.transpose() * R_12_ * B))) {}

Vector3 PairRotation::omega(const NodeState& first, const NodeState& second) const {
  return A_.transpose() * (R_12_ * second.Omega - first.Omega);
}

//   J^T c = [-a; R_12^T a],  a = A c in node 1's axes;   d(J^T c) at fixed c: only in the rows of dTheta_2,
//   d(R_12^T a) = (R_12^T a)~ dTheta_2 - R_12^T a~ dTheta_1
//   g = J^T T^-1 e,   dg = d(J^T) T^-1 e + J^T D(T^-1 e)[dpsi]
void PairRotation::calc(int axis, const NodeState& first, const NodeState& second, CoordinateJet& jet) const {
  jet.value = jet.principal = psi_[axis];
  jet.rate = omega(first, second)[axis];
  constexpr int turn_1 = 3, turn_2 = 9;
  const auto add_gradient = [&](const Vector3& c, CoordinateJet::VectorMap gradient, CoordinateJet::MatrixMap slope) {
    const Vector3 a = A_ * c, a_2 = R_12_.transpose() * a;
    gradient.segment<3>(turn_1) = -a;
    gradient.segment<3>(turn_2) = a_2;
    slope.block<3, 3>(turn_2, turn_1) = -R_12_.transpose() * skew(a);
    slope.block<3, 3>(turn_2, turn_2) = skew(a_2);
  };
  const Vector3 e = Vector3::Unit(axis);
  add_gradient(e, jet.w(), jet.W());
  const Matrix3 T_inverse = tangent_inverse(psi_);
  add_gradient(T_inverse * e, jet.g(), jet.S());
  Matrix3 by_psi;  // D(T^-1 e)
  for (int k = 0; k < 3; ++k) by_psi.col(k) = tangent_inverse_derivative(psi_, Vector3::Unit(k)) * e;
  Eigen::Matrix<double, 3, 6> J;
  J << -A_.transpose(), A_.transpose() * R_12_;
  const Eigen::Matrix<double, 6, 6> bend = J.transpose() * by_psi * T_inverse.transpose() * J;
  auto S = jet.S();
  for (const auto& [to, from] : {std::pair{turn_1, 0}, std::pair{turn_2, 3}}) {
    S.block<3, 3>(to, turn_1) += bend.block<3, 3>(from, 0);
    S.block<3, 3>(to, turn_2) += bend.block<3, 3>(from, 3);
  }
}

}  // namespace bielle::mechanism
