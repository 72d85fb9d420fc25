#include "mechanism/measures/pair_measure.hpp"

#include <cmath>

#include "mechanism/measures/turns.hpp"

namespace bielle::mechanism {

namespace {

/// Returns a~ b~.
Matrix3 skew_product(const Vector3& a, const Vector3& b) {
  Matrix3 product = b * a.transpose();
  product.diagonal().array() -= a.dot(b);
  return product;
}

}  // namespace

void PairHessian::add_to(LocalMatrix& matrix, bool positions, bool coupling) const {
  if (positions) {
    matrix.add(0, 3, X);
    matrix.add(3, 0, X.transpose());
    matrix.add(3, 6, -X.transpose());
    matrix.add(6, 3, -X);
  }
  matrix.add(3, 3, P);
  matrix.add(9, 9, W);
  if (!coupling) return;
  matrix.add(3, 9, Q);
  matrix.add(9, 3, Q.transpose());
}

Matrix12 PairHessian::dense() const {
  Matrix12 S = Matrix12::Zero();
  LocalMatrix blocks(S);
  add_to(blocks, true, true);
  return S;
}

PointPair::PointPair(const NodeState& first, const NodeState& second, const Matrix3& R_12, const Vector3& c_2)
    : c_2_(c_2), s_(first.R.transpose() * (second.x + second.R * c_2 - first.x)), R_1_(first.R), R_12_(R_12) {}

//        dx_1        dTheta_1         dx_2        dTheta_2
// g = [ -e           e^ x s           e           c_2 x e_2 ]      e_2 = R_2^T e
// S = [  0           R_1 e^~          0           0
//       -e^~ R_1^T   e^~ s~           e^~ R_1^T  -e^~ R_12 c_2~
//        0          -R_1 e^~          0           0
//        0          -c_2~ R_12^T e^~  0           c_2~ e_2~ ]
Vector12 PointPair::gradient(const Vector3& e_hat) const {
  const Vector3 e = R_1_ * e_hat;
  Vector12 g;
  g << -e, e_hat.cross(s_), e, c_2_.cross(R_12_.transpose() * e_hat);
  return g;
}

void PointPair::add_second(const Vector3& e_hat, PairHessian& S) const {
  const Matrix3 e_skew = skew(e_hat);
  S.X += R_1_ * e_skew;
  S.P += skew_product(e_hat, s_);
  S.Q -= e_skew * (R_12_ * skew(c_2_));
  S.W += skew_product(c_2_, R_12_.transpose() * e_hat);
}

PointGap::PointGap(const NodeState& first, const NodeState& second, const Vector3& c_1, const Vector3& c_2)
    : c_1_(c_1),
      c_2_(c_2),
      R_1_(first.R),
      R_2_(second.R),
      value_(second.x - first.x + second.R * c_2 - first.R * c_1) {}

Vector3 PointGap::rate(const NodeState& first, const NodeState& second) const {
  return second.v - first.v + R_2_ * second.Omega.cross(c_2_) - R_1_ * first.Omega.cross(c_1_);
}

Vector3 PointGap::acceleration(const NodeState& first, const NodeState& second) const {
  const auto of_arm = [](const NodeState& node, const Vector3& c) -> Vector3 {
    return node.Omegadot.cross(c) + node.Omega.cross(node.Omega.cross(c));
  };
  return second.a - first.a + R_2_ * of_arm(second, c_2_) - R_1_ * of_arm(first, c_1_);
}

//        dx_1   dTheta_1      dx_2   dTheta_2
// g = [ -1      R_1 c_1~      1     -R_2 c_2~ ]      f_k = R_k^T f
// S = [  0      0             0      0
//        0     -c_1~ f_1~     0      0
//        0      0             0      0
//        0      0             0      c_2~ f_2~ ]
void PointGap::add_forces(const Vector3& force, Eigen::Ref<VectorX> r) const {
  r.segment<3>(0) -= force;
  r.segment<3>(3) -= c_1_.cross(R_1_.transpose() * force);
  r.segment<3>(6) += force;
  r.segment<3>(9) += c_2_.cross(R_2_.transpose() * force);
}

void PointGap::add_gradients(int row, LocalMatrix& S) const {
  const Matrix3 turn_1 = R_1_ * skew(c_1_), turn_2 = -R_2_ * skew(c_2_);
  S.add_identity(row, 0, -1);
  S.add_identity(0, row, -1);
  S.add_identity(row, 6, 1);
  S.add_identity(6, row, 1);
  S.add(row, 3, turn_1);
  S.add(3, row, turn_1.transpose());
  S.add(row, 9, turn_2);
  S.add(9, row, turn_2.transpose());
}

void PointGap::add_second(const Vector3& force, PairHessian& S) const {
  S.P -= skew_product(c_1_, R_1_.transpose() * force);
  S.W += skew_product(c_2_, R_2_.transpose() * force);
}

//      dTheta_1            dTheta_2
// g = [ a^ x b_1           b^ x a_2 ]
// S = [ a^~ b_1~          -a^~ R_12 b^~
//      -b^~ R_12^T a^~     b^~ a_2~ ]
void AxisPair::add_second(double factor, PairHessian& S) const {
  S.P += factor * skew_product(a_hat_, b_1_);
  S.Q -= factor * (skew(a_hat_) * (R_12_ * skew(b_hat_)));
  S.W += factor * skew_product(b_hat_, a_2_);
}

template <int order>
PairMeasureOf<order> measure_position(const NodeState& first, const NodeState& second, const Vector3& e_hat,
                                      const Vector3& c_1, const Vector3& c_2) {
  const PointPair pair(first, second, first.R.transpose() * second.R, c_2);
  PairMeasureOf<order> m{pair.value(e_hat, c_1), pair.gradient(e_hat)};
  if constexpr (order == 2) {
    PairHessian S;
    pair.add_second(e_hat, S);
    m.second = S.dense();
  }
  return m;
}

template <int order>
PairMeasureOf<order> measure_alignment(const NodeState& first, const NodeState& second, const Vector3& a_hat,
                                       const Vector3& b_hat) {
  const Matrix3 R_12 = first.R.transpose() * second.R;
  const AxisPair pair(R_12, a_hat, b_hat);
  PairMeasureOf<order> m(pair.value());
  m.gradient.template segment<3>(3) = pair.first_gradient();
  m.gradient.template segment<3>(9) = pair.second_gradient();
  if constexpr (order == 2) {
    PairHessian S;
    pair.add_second(1, S);
    m.second = S.dense();
  }
  return m;
}

template <int order>
PairMeasureOf<order> measure_angle(const NodeState& first, const NodeState& second, const Matrix3& A,
                                   const Matrix3& B) {
  return atan2(measure_alignment<order>(first, second, A.col(1), B.col(0)),
               measure_alignment<order>(first, second, A.col(0), B.col(0)));
}

template PairSlope measure_position(const NodeState&, const NodeState&, const Vector3&, const Vector3&, const Vector3&);
template PairMeasure measure_position(const NodeState&, const NodeState&, const Vector3&, const Vector3&,
                                      const Vector3&);
template PairSlope measure_alignment(const NodeState&, const NodeState&, const Vector3&, const Vector3&);
template PairMeasure measure_alignment(const NodeState&, const NodeState&, const Vector3&, const Vector3&);
template PairSlope measure_angle(const NodeState&, const NodeState&, const Matrix3&, const Matrix3&);
template PairMeasure measure_angle(const NodeState&, const NodeState&, const Matrix3&, const Matrix3&);

template <int order>
PairMeasureOf<order> exchanged(const PairMeasureOf<order>& measure) {
  PairMeasureOf<order> result(measure.value);
  const auto& g = measure.gradient;
  result.gradient << g.template tail<6>(), g.template head<6>();
  if constexpr (order == 2) {
    const auto& S = measure.second;
    result.second << S.template bottomRightCorner<6, 6>(), S.template bottomLeftCorner<6, 6>(),
        S.template topRightCorner<6, 6>(), S.template topLeftCorner<6, 6>();
  }
  return result;
}

template PairSlope exchanged<1>(const PairSlope&);
template PairMeasure exchanged<2>(const PairMeasure&);

PairMeasureRate measure_position_rate(const NodeState& first, const NodeState& second, const Vector3& e_hat,
                                      const Vector3& c_1, const Vector3& c_2) {
  const Vector3 s = first.R.transpose() * (second.x + second.R * c_2 - first.x);
  const Vector3 s_rate =
      first.R.transpose() * (second.v + second.R * second.Omega.cross(c_2) - first.v) - first.Omega.cross(s);
  return {e_hat.dot(s - c_1), e_hat.dot(s_rate)};
}

PairMeasureRate measure_angle_rate(const NodeState& first, const NodeState& second, const Matrix3& A,
                                   const Matrix3& B) {
  const Vector3 b = first.R.transpose() * (second.R * B.col(0));
  const Vector3 relative = first.R.transpose() * (second.R * second.Omega) - first.Omega;
  const Vector3 b_rate = relative.cross(b);
  const double s = A.col(1).dot(b), c = A.col(0).dot(b);
  return {std::atan2(s, c), (c * A.col(1).dot(b_rate) - s * A.col(0).dot(b_rate)) / (s * s + c * c)};
}

double unwrap_angle(double angle, double previous) {
  return angle + 2 * M_PI * std::round((previous - angle) / (2 * M_PI));
}

}  // namespace bielle::mechanism
