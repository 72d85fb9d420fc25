// Orders of convergence of several values at once.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace bielle::test {

/// Exponents p of error ~ h^p between refinements by two.
inline Eigen::VectorXd orders(const Eigen::VectorXd& errors) {
  const Eigen::Index levels = errors.size();
  return (errors.head(levels - 1).cwiseQuotient(errors.tail(levels - 1)).array().log() / std::log(2.0)).matrix();
}

}  // namespace bielle::test
