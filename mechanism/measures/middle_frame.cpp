#include "mechanism/measures/middle_frame.hpp"

#include <numbers>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

MiddleFrame::MiddleFrame(const NodeState& first, const NodeState& second, const Frame& A, const Frame& B,
                         const Vector3& u_0)
    : rotation_(first, second, A.R, B.R), points_(first, second, first.R.transpose() * second.R, B.x), A_(A.R) {
  h_ = 0.5 * rotation_.psi();
  half_ = exp_so3(h_);
  T_ = tangent(h_);
  M_ = first.R * A.R * half_;
  Vector3 d;
  for (int k = 0; k < 3; ++k) {
    d[k] = points_.value(A_.col(k), A.x);
    approach_.row(k) = points_.gradient(A_.col(k)).transpose();
  }
  way_ = half_.transpose() * d;
  turn_ = rotation_.gradients();
  value_ << way_ - u_0, rotation_.psi();
}

void MiddleFrame::calc(std::span<PairMeasure, 6> measures, bool second_too) const {
  const Matrix3 by_turn = 0.5 * skew(way_) * T_;
  const Eigen::Matrix<double, 3, 12> u = half_.transpose() * approach_ + by_turn * turn_;
  for (int k = 0; k < 3; ++k) {
    PairMeasure &of_u = measures[static_cast<std::size_t>(k)], &of_psi = measures[static_cast<std::size_t>(3 + k)];
    of_u.value = value_[k];
    of_u.gradient = u.row(k).transpose();
    of_psi.value = value_[3 + k];
    of_psi.gradient = turn_.row(k).transpose();
  }
  if (!second_too) return;
  for (int k = 0; k < 6; ++k) measures[static_cast<std::size_t>(k)].second = second(Vector6::Unit(k));
}

// With the factors f of u, w = u + u_0 and increments (d', e) of (d, psi), the second derivative of f . u along them is
//     1/2 f . (exp(-h) d' x T e) twice, and 1/4 f . [(w x T e) x T e' + w x DT(h)[e] e'].
Matrix12 MiddleFrame::second(const Vector6& factor) const {
  const Vector3 f = factor.head<3>(), of_psi = factor.tail<3>() + 0.5 * T_.transpose() * f.cross(way_);
  Matrix12 S = Matrix12::Zero();
  rotation_.add_second(of_psi, S);
  if (f.isZero(0)) return S;
  PairHessian of_points;
  points_.add_second(A_ * (half_ * f), of_points);
  S += of_points.dense();
  const Matrix3 mixed = -0.5 * half_ * skew(f) * T_;  // with respect to (d', e)
  Matrix3 bend = T_.transpose() * skew(way_) * skew(f) * T_;
  const Vector3 g = f.cross(way_);
  for (int k = 0; k < 3; ++k) bend.row(k) += (tangent_derivative(h_, Vector3::Unit(k)).transpose() * g).transpose();
  bend *= 0.25;
  const Eigen::Matrix<double, 3, 12> from_approach = mixed.transpose() * approach_, from_turn = mixed * turn_;
  S.noalias() += approach_.transpose() * from_turn;
  S.noalias() += turn_.transpose() * from_approach;
  const Eigen::Matrix<double, 3, 12> bent = bend * turn_;
  S.noalias() += turn_.transpose() * bent;
  return S;
}

void check_half_turn(const LocalState& state, const std::string& who, const Vector3& psi, const Vector3& before,
                     const std::string& advice) {
  constexpr double largest = 0.95 * std::numbers::pi;
  const bool passed = (psi - before).norm() > std::numbers::pi;
  if (!passed && psi.norm() <= largest) return;
  const std::string when = state.environment().statics
                               ? fmt::format("load factor {:.6g}", state.environment().load_factor)
                               : fmt::format("t = {:.6g} s", state.time());
  throw ComputationError(
      fmt::format("{}: {}: its nodes have turned {} against each other, and it follows up to {:.0f}. {}", when, who,
                  passed ? std::string("past 180 degrees") : fmt::format("by {:.0f} degrees", degrees(psi.norm())),
                  degrees(largest), advice));
}

}  // namespace bielle::mechanism
