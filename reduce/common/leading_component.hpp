// The component of a vector that decides its sign, where that is free: the same whatever rounding does.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace bielle {

/// The first of the components that are largest but for rounding: modes of symmetric bodies have several. 0 of an empty
/// vector.
inline double leading_component(const Eigen::Ref<const Eigen::VectorXd>& vector) {
  constexpr double nearly = 1 - 1e-6;
  if (vector.size() == 0) return 0;
  const double largest = vector.cwiseAbs().maxCoeff();
  return *std::find_if(vector.begin(), vector.end() - 1, [&](double x) { return std::abs(x) >= nearly * largest; });
}

}  // namespace bielle
