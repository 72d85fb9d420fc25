// Random vectors and matrices with fixed seeds: the same numbers on every machine.
#pragma once

#include <random>

#include <Eigen/Core>

namespace bielle::test {

/// A generator whose numbers do not depend on the standard library (std::uniform_real_distribution may differ).
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967295.0);
  }
  /// Returns a vector with components in [-scale, scale].
  Eigen::VectorXd vector(Eigen::Index size, double scale = 1) {
    Eigen::VectorXd v(size);
    for (Eigen::Index i = 0; i < size; ++i) v[i] = uniform(-scale, scale);
    return v;
  }
  Eigen::Vector3d vector3(double scale = 1) { return vector(3, scale); }
  /// Returns a vector of the given length in a random direction.
  Eigen::Vector3d vector_of_length(double length) {
    for (;;) {
      const Eigen::Vector3d v = vector3();
      if (v.norm() > 0.1) return length * v.normalized();
    }
  }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns, double scale = 1) {
    Eigen::MatrixXd A(rows, columns);
    for (Eigen::Index j = 0; j < columns; ++j) A.col(j) = vector(rows, scale);
    return A;
  }
  /// Returns a symmetric positive definite matrix with eigenvalues in about [0.5, size].
  Eigen::MatrixXd positive_matrix(Eigen::Index size) {
    const Eigen::MatrixXd A = matrix(size, size);
    return 0.5 * Eigen::MatrixXd::Identity(size, size) + A * A.transpose();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace bielle::test
