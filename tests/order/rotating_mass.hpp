// Generalised-alpha of index 3 for a mass that is guided by a hinge, implemented independently of the program in the
// plane, where the group is commutative. Linearised about steady rotation, it shows how errors grow from step to step.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "mechanism/solvers/dynamics/scheme.hpp"

namespace bielle::test {

class RotatingMass {
 public:
  /// 1 kg at 1 m from the axis, turning by 1 rad/s. @param inertia  about its centre [kg m^2]. @param h  step [s].
  /// @param corrected  velocities across the constraints are given their offset after each step
  RotatingMass(const mechanism::Scheme& scheme, double inertia, double h, bool corrected)
      : scheme_(scheme), inverse_mass_(1, 1, 1 / inertia), h_(h), corrected_(corrected) {}

  /// Returns the largest eigenvalue of a step's linearisation in axes that turn with the mass, except the two
  /// eigenvalues 1, which belong to another phase and another speed.
  double spectral_radius() const {
    const Matrix D = derivative(steady());
    Eigen::VectorXcd roots = Matrix(D).eigenvalues();
    for (int trivial = 0; trivial < 2; ++trivial) {
      Eigen::Index nearest = 0;
      (roots.array() - 1).abs().minCoeff(&nearest);
      roots[nearest] = 0;
    }
    return roots.cwiseAbs().maxCoeff();
  }

 private:
  using Vector3 = Eigen::Vector3d;              ///< x, y, angle
  using Vector = Eigen::Matrix<double, 12, 1>;  ///< q, v, A, a
  using Matrix = Eigen::Matrix<double, 12, 12>;
  using Jacobian = Eigen::Matrix<double, 2, 3>;

  static Jacobian B(const Vector3& q) { return (Jacobian() << 1, 0, std::sin(q[2]), 0, 1, -std::cos(q[2])).finished(); }
  static Eigen::Vector2d Phi(const Vector3& q) { return {q[0] - std::cos(q[2]), q[1] - std::sin(q[2])}; }

  Vector step(const Vector& z) const {
    const auto [alpha_m, alpha_f, gamma, beta] = scheme_;
    const Vector3 q = z.segment<3>(0), v = z.segment<3>(3), A = z.segment<3>(6), a = z.segment<3>(9);
    const double factor = (1 - alpha_m) / ((1 - alpha_f) * beta * h_ * h_);
    Vector3 a_new = a, A_new, q_new;
    Eigen::Vector2d lambda = -a.head<2>();
    for (int iteration = 0; iteration < 12; ++iteration) {
      A_new = ((1 - alpha_f) * a_new + alpha_f * a - alpha_m * A) / (1 - alpha_m);
      q_new = q + h_ * v + h_ * h_ * ((0.5 - beta) * A + beta * A_new);
      const Jacobian b = B(q_new);
      Eigen::Matrix<double, 5, 5> J;
      J << Eigen::Matrix3d(factor * inverse_mass_.cwiseInverse().asDiagonal()), b.transpose(), b,
          Eigen::Matrix2d::Zero();
      J(2, 2) += lambda[0] * std::cos(q_new[2]) + lambda[1] * std::sin(q_new[2]);
      Eigen::Matrix<double, 5, 1> r;
      r << a_new.cwiseQuotient(inverse_mass_) + b.transpose() * lambda, Phi(q_new);
      const Eigen::Matrix<double, 5, 1> delta = J.fullPivHouseholderQr().solve(-r);
      a_new += factor * delta.head<3>();
      lambda += delta.tail<2>();
    }
    A_new = ((1 - alpha_f) * a_new + alpha_f * a - alpha_m * A) / (1 - alpha_m);
    q_new = q + h_ * v + h_ * h_ * ((0.5 - beta) * A + beta * A_new);
    Vector3 v_new = v + h_ * ((1 - gamma) * A + gamma * A_new);
    if (corrected_) {
      const Jacobian b = B(q_new);
      const Eigen::Matrix<double, 3, 2> across = inverse_mass_.asDiagonal() * b.transpose();
      v_new += across * (b * across).inverse() * (b * (scheme_.position_error() * h_ * (A_new - A)) - b * v_new);
    }
    return (Vector() << q_new, v_new, A_new, a_new).finished();
  }

  static Vector turned(const Vector& z, double angle) {
    Vector result = z;
    const Eigen::Rotation2Dd R(angle);
    for (int k = 0; k < 12; k += 3) result.segment<2>(k) = R * z.segment<2>(k);
    result[2] += angle;
    return result;
  }

  /// Returns a state at angle 0 that a step only turns, by Newton's method. The angle per step takes the place of the
  /// angle.
  Vector steady() const {
    Vector y;
    y << 1, 0, h_, 0, 1, 1, -1, 0, 0, -1, 0, 0;
    const auto misses = [&](const Vector& u) {
      Vector z = u;
      z[2] = 0;
      Vector f = turned(step(z), -u[2]) - z;
      f[0] = u[0] - 1;
      f[5] = u[5] - 1;
      return f;
    };
    for (int iteration = 0; iteration < 20; ++iteration)
      y -= gradient(misses, y).fullPivHouseholderQr().solve(misses(y));
    return y;
  }
  Matrix derivative(const Vector& steady) const {
    Vector z = steady;
    z[2] = 0;
    return gradient([&](const Vector& u) { return turned(step(u), -steady[2]); }, z);
  }
  template <class Function>
  static Matrix gradient(const Function& f, const Vector& at) {
    constexpr double small = 1e-6;
    Matrix D;
    for (int i = 0; i < 12; ++i) {
      const Vector e = small * Vector::Unit(i);
      D.col(i) = (f(at + e) - f(at - e)) / (2 * small);
    }
    return D;
  }

  mechanism::Scheme scheme_;
  Vector3 inverse_mass_;
  double h_;
  bool corrected_;
};

}  // namespace bielle::test
