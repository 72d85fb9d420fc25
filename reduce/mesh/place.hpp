// Places and directions in messages.
#pragma once

#include <cmath>
#include <string>

#include <Eigen/Core>
#include <fmt/format.h>

namespace bielle::reduce {

/// "(0.2, 0, -0.013)"; components that are rounding errors beside the largest are shown as 0.
inline std::string direction_name(const Eigen::Vector3d& v) {
  const double noise = 1e-9 * v.cwiseAbs().maxCoeff();
  const auto shown = [&](double x) { return std::abs(x) <= noise ? 0.0 : x; };
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", shown(v.x()), shown(v.y()), shown(v.z()));
}

/// "(0.2, 0, -0.013) m"; less than an atom's diameter is 0.
inline std::string place_name(const Eigen::Vector3d& point) {
  return direction_name((point.array().abs() < 1e-10).select(0.0, point)) + " m";
}

}  // namespace bielle::reduce
