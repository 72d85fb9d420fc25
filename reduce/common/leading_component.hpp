// The component of a vector that decides its sign if the sign is free: the choice does not depend on rounding.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace bielle {

/// Index of the first component that is largest up to rounding, since modes of symmetric bodies have several. It is 0
/// for an empty vector.
inline double leading_component(const Eigen::Ref<const Eigen::VectorXd>& vector) {
  constexpr double nearly = 1 - 1e-6;
  if (vector.size() == 0) return 0;
  const double largest = vector.cwiseAbs().maxCoeff();
  return *std::find_if(vector.begin(), vector.end() - 1, [&](double x) { return std::abs(x) >= nearly * largest; });
}

}  // namespace bielle
