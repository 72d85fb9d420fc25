#include "mechanism/joints/measure.hpp"

#include <cmath>

namespace bielle::mechanism {

Measure measure_position(const NodeState& first, const NodeState& second, const Vector3& e_hat, const Vector3& c_1,
                         const Vector3& c_2) {
  //        dx_1        dTheta_1         dx_2        dTheta_2
  // g = [ -e           e^ x s           e           c_2 x e_2 ]      s = R_1^T (p_2 - x_1), e_2 = R_2^T e
  // S = [  0           R_1 e^~          0           0
  //       -e^~ R_1^T   e^~ s~           e^~ R_1^T  -e^~ R_12 c_2~
  //        0          -R_1 e^~          0           0
  //        0          -c_2~ R_12^T e^~  0           c_2~ e_2~ ]
  const Vector3 e = first.R * e_hat;
  const Matrix3 R_12 = first.R.transpose() * second.R;
  const Vector3 s = first.R.transpose() * (second.x + second.R * c_2 - first.x);
  const Vector3 e_2 = R_12.transpose() * e_hat;
  const Matrix3 e_skew = skew(e_hat), c_skew = skew(c_2);
  const Matrix3 turned = first.R * e_skew;
  Measure m;
  m.value = e_hat.dot(s - c_1);
  m.gradient << -e, e_hat.cross(s), e, c_2.cross(e_2);
  m.second.block<3, 3>(0, 3) = turned;
  m.second.block<3, 3>(3, 0) = turned.transpose();  // -e^~ R_1^T
  m.second.block<3, 3>(3, 3) = e_skew * skew(s);
  m.second.block<3, 3>(3, 6) = -turned.transpose();
  m.second.block<3, 3>(3, 9) = -e_skew * R_12 * c_skew;
  m.second.block<3, 3>(6, 3) = -turned;
  m.second.block<3, 3>(9, 3) = -c_skew * R_12.transpose() * e_skew;
  m.second.block<3, 3>(9, 9) = c_skew * skew(e_2);
  return m;
}

Measure measure_alignment(const NodeState& first, const NodeState& second, const Vector3& a_hat, const Vector3& b_hat) {
  //      dTheta_1            dTheta_2
  // g = [ a^ x b_1           b^ x a_2 ]            b_1 = R_12 b^, a_2 = R_12^T a^
  // S = [ a^~ b_1~          -a^~ R_12 b^~
  //      -b^~ R_12^T a^~     b^~ a_2~ ]
  const Matrix3 R_12 = first.R.transpose() * second.R;
  const Vector3 b_1 = R_12 * b_hat, a_2 = R_12.transpose() * a_hat;
  const Matrix3 a_skew = skew(a_hat), b_skew = skew(b_hat);
  Measure m;
  m.value = a_hat.dot(b_1);
  m.gradient.segment<3>(3) = a_hat.cross(b_1);
  m.gradient.segment<3>(9) = b_hat.cross(a_2);
  m.second.block<3, 3>(3, 3) = a_skew * skew(b_1);
  m.second.block<3, 3>(3, 9) = -a_skew * R_12 * b_skew;
  m.second.block<3, 3>(9, 3) = -b_skew * R_12.transpose() * a_skew;
  m.second.block<3, 3>(9, 9) = b_skew * skew(a_2);
  return m;
}

Measure measure_angle(const NodeState& first, const NodeState& second, const Matrix3& A, const Matrix3& B) {
  const Measure s = measure_alignment(first, second, A.col(1), B.col(0));
  const Measure c = measure_alignment(first, second, A.col(0), B.col(0));
  // theta = atan2(s, c): dtheta = (c ds - s dc)/w, w = s^2 + c^2; dw = 2 (s ds + c dc)
  const double w = s.value * s.value + c.value * c.value;
  Measure m;
  m.value = std::atan2(s.value, c.value);
  m.gradient = (c.value * s.gradient - s.value * c.gradient) / w;
  const Vector12 dw = 2 * (s.value * s.gradient + c.value * c.gradient);
  m.second = (c.value * s.second - s.value * c.second + s.gradient * c.gradient.transpose() -
              c.gradient * s.gradient.transpose() - m.gradient * dw.transpose()) /
             w;
  return m;
}

double unwrap_angle(double angle, double previous) {
  return angle + 2 * M_PI * std::round((previous - angle) / (2 * M_PI));
}

}  // namespace bielle::mechanism
