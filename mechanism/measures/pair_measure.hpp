// Scalar measures of the relative motion of two nodes: joints constrain, drive and report them.
//
// A measure m(q) of nodes 1 and 2 has, along the increments dz = [dx_1; dTheta_1; dx_2; dTheta_2],
//     dm = g . dz,   dg = S dz,   hence   mdot = g . v,   mddot = g . a + v . S v
// with v = [xdot_1; Omega_1; xdot_2; Omega_2]. S is not symmetric: rotational increments do not commute.
#pragma once

#include "mechanism/math/se3.hpp"
#include "mechanism/model/local_tangent.hpp"
#include "mechanism/model/state.hpp"
#include "reduce/common/autodiff.hpp"

namespace bielle::mechanism {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Returns velocities or accelerations of the two nodes in the order of the increments.
inline Vector12 pair_rate(const NodeState& first, const NodeState& second) {
  Vector12 v;
  v << first.v, first.Omega, second.v, second.Omega;
  return v;
}
inline Vector12 pair_acceleration(const NodeState& first, const NodeState& second) {
  Vector12 a;
  a << first.a, first.Omegadot, second.a, second.Omegadot;
  return a;
}

/// Second derivatives of measures: the blocks of S that are not zero.
///     [ 0    X    0    0  ]
/// S = [ X^T  P   -X^T  Q  ]
///     [ 0   -X    0    0  ]
///     [ 0    Q^T  0    W  ]
struct PairHessian {
  Matrix3 X = Matrix3::Zero(), P = Matrix3::Zero(), Q = Matrix3::Zero(), W = Matrix3::Zero();
  /// @param positions  whether X is written; @param coupling  whether Q is written
  void add_to(LocalMatrix& matrix, bool positions, bool coupling) const;
  Matrix12 dense() const;
};

/// A measure with its derivatives; of order 1 (its gradient alone) for residuals, of order 2 for tangents.
template <int order>
using PairMeasureOf = AutoDiff<12, order>;
using PairMeasure = PairMeasureOf<2>;
using PairSlope = PairMeasureOf<1>;

/// Positions of a point p_2 = x_2 + R_2 c_2 of node 2 relative to node 1: measures e . (p_2 - p_1), p_1 = x_1 + R_1
/// c_1, along axes e = R_1 e^ carried by node 1. Gradient and second derivative are linear in e^: several axes, each
/// with a factor, can be added to a single one.
class PointPair {
 public:
  /// @param R_12  R_1^T R_2
  PointPair(const NodeState& first, const NodeState& second, const Matrix3& R_12, const Vector3& c_2);
  double value(const Vector3& e_hat, const Vector3& c_1) const { return e_hat.dot(s_ - c_1); }
  Vector12 gradient(const Vector3& e_hat) const;
  void add_second(const Vector3& e_hat, PairHessian& S) const;

 private:
  Vector3 c_2_, s_;  ///< s = R_1^T (p_2 - x_1)
  Matrix3 R_1_, R_12_;
};

/// The vector p_2 - p_1 from a point p_1 = x_1 + R_1 c_1 of node 1 to a point p_2 = x_2 + R_2 c_2 of node 2, inertial:
/// three measures at once, whose second derivatives do not couple the nodes.
class PointGap {
 public:
  PointGap(const NodeState& first, const NodeState& second, const Vector3& c_1, const Vector3& c_2);
  const Vector3& value() const { return value_; }
  Vector3 rate(const NodeState& first, const NodeState& second) const;
  Vector3 acceleration(const NodeState& first, const NodeState& second) const;
  /// Adds g^T f of an inertial force f on node 2 to the first twelve rows of a vector.
  void add_forces(const Vector3& force, Eigen::Ref<VectorX> r) const;
  /// Adds g to three rows of a matrix from `row` on, and g^T to its columns.
  void add_gradients(int row, LocalMatrix& S) const;
  /// Adds the derivative d(g^T f).
  void add_second(const Vector3& force, PairHessian& S) const;

 private:
  const Vector3 &c_1_, &c_2_;
  const Matrix3 &R_1_, &R_2_;
  Vector3 value_;
};

/// Alignment a . b of axes a = R_1 a^ carried by node 1 and b = R_2 b^ carried by node 2.
class AxisPair {
 public:
  /// @param R_12  R_1^T R_2, which several pairs of the same nodes share; it must outlive them
  AxisPair(const Matrix3& R_12, const Vector3& a_hat, const Vector3& b_hat)
      : a_hat_(a_hat), b_hat_(b_hat), b_1_(R_12 * b_hat), a_2_(R_12.transpose() * a_hat), R_12_(R_12) {}
  AxisPair(Matrix3&& R_12, const Vector3& a_hat, const Vector3& b_hat) = delete;
  double value() const { return a_hat_.dot(b_1_); }
  /// The gradient is zero except for its parts along dTheta_1 and dTheta_2.
  Vector3 first_gradient() const { return a_hat_.cross(b_1_); }
  Vector3 second_gradient() const { return b_hat_.cross(a_2_); }
  void add_second(double factor, PairHessian& S) const;

 private:
  Vector3 a_hat_, b_hat_, b_1_, a_2_;  ///< b_1 = R_12 b^, a_2 = R_12^T a^
  const Matrix3& R_12_;
};

// The following functions exist for orders 1 and 2.

/// Computes the position measure of one axis, with its derivatives.
template <int order = 2>
PairMeasureOf<order> measure_position(const NodeState& first, const NodeState& second, const Vector3& e_hat,
                                      const Vector3& c_1, const Vector3& c_2);

/// Computes the alignment measure, with its derivatives.
template <int order = 2>
PairMeasureOf<order> measure_alignment(const NodeState& first, const NodeState& second, const Vector3& a_hat,
                                       const Vector3& b_hat);

/// Computes the angle atan2(y_A . x_B, x_A . x_B) in (-pi, pi] by which frame B of node 2 is rotated relative to frame
/// A of node 1 about their common z axis. @param A,B  axes in the components of their nodes
template <int order = 2>
PairMeasureOf<order> measure_angle(const NodeState& first, const NodeState& second, const Matrix3& A, const Matrix3& B);

/// Converts a measure of nodes (second, first) to one of (first, second).
template <int order>
PairMeasureOf<order> exchanged(const PairMeasureOf<order>& measure);

/// A measure with its rate only: for quantities that are recorded and stored at every step.
struct PairMeasureRate {
  double value = 0, rate = 0;
};
PairMeasureRate measure_position_rate(const NodeState& first, const NodeState& second, const Vector3& e_hat,
                                      const Vector3& c_1, const Vector3& c_2);
PairMeasureRate measure_angle_rate(const NodeState& first, const NodeState& second, const Matrix3& A, const Matrix3& B);

}  // namespace bielle::mechanism
