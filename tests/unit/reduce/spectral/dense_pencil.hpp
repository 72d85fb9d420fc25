// Small pencils K - lambda M of dense matrices, and their eigenvalues by a dense solver.
#pragma once

#include <Eigen/Cholesky>

#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/spectral/eigenpairs.hpp"
#include "reduce/spectral/start_vectors.hpp"

namespace bielle::test {

struct DensePencil {
  Eigen::MatrixXd K, M;
  double shift = 0;
  Eigen::LLT<Eigen::MatrixXd> factor{K - shift * M};

  ShiftInvertProblem problem() const {
    return {K.rows(), shift, [this](const Eigen::MatrixXd& b) { return Eigen::MatrixXd(factor.solve(b)); },
            [this](const Eigen::MatrixXd& x) { return Eigen::MatrixXd(M * x); }};
  }

  /// Returns all finite eigenvalues in ascending order, from M y = nu (K - shift M) y with lambda = shift + 1/nu.
  Eigen::VectorXd values() const {
    const Eigen::VectorXd nu = symmetric_eigenpairs(M, K - shift * M)->values.reverse();
    const Eigen::Index finite = (nu.array() > 1e-12 * nu(0)).count();
    return shift + nu.head(finite).array().inverse();
  }

  /// Returns the largest |K phi - lambda M phi| / |K phi|.
  double residual(const Eigenpairs& pairs) const {
    const Eigen::MatrixXd forces = K * pairs.vectors;
    const Eigen::MatrixXd error = forces - M * pairs.vectors * pairs.values.asDiagonal();
    return (error.colwise().norm().array() / forces.colwise().norm().array()).maxCoeff();
  }

  /// Returns the largest entry of Phi^T M Phi - I.
  double orthogonality(const Eigenpairs& pairs) const {
    const Eigen::Index n = pairs.vectors.cols();
    return (pairs.vectors.transpose() * M * pairs.vectors - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
  }
};

/// Returns a matrix with given eigenvalues and arbitrary eigenvectors.
inline Eigen::MatrixXd with_eigenvalues(const Eigen::VectorXd& values) {
  const Eigen::MatrixXd any = StartVectors(values.size()).draw(values.size());
  const Eigen::MatrixXd Q = symmetric_eigenpairs(any + any.transpose()).vectors;
  const Eigen::MatrixXd A = Q * values.asDiagonal() * Q.transpose();
  return (A + A.transpose()) / 2;
}

/// Returns the stiffness of a chain of `springs.size() - 1` masses between walls.
inline Eigen::MatrixXd chain_of_springs(const Eigen::VectorXd& springs) {
  const Eigen::Index n = springs.size() - 1;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    K(k, k) = springs(k) + springs(k + 1);
    if (k > 0) K(k, k - 1) = K(k - 1, k) = -springs(k);
  }
  return K;
}

}  // namespace bielle::test
