// Solutions of dense systems of equations, for tests that solve one of a kind.
#pragma once

#include "reduce/dense/dense_solves.hpp"

namespace bielle::test {

/// Returns x = A^-1 b.
inline Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  LUFactors factors;
  factors.compute(A);
  Eigen::VectorXd x(b.size());
  factors.solve(b, x);
  return x;
}

}  // namespace bielle::test
