// Points, directions and lengths in messages.
#pragma once

#include <cmath>
#include <string>

#include <Eigen/Core>
#include <fmt/format.h>

namespace bielle::reduce {

/// "(0.2, 0, -0.013)"; components that are rounding errors relative to the largest are shown as 0.
inline std::string direction_name(const Eigen::Vector3d& v) {
  const double noise = 1e-9 * v.cwiseAbs().maxCoeff();
  const auto shown = [&](double x) { return std::abs(x) <= noise ? 0.0 : x; };
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", shown(v.x()), shown(v.y()), shown(v.z()));
}

/// "(0.2, 0, -0.013) m"; components below an atom's diameter are shown as 0.
inline std::string place_name(const Eigen::Vector3d& point) {
  return direction_name((point.array().abs() < 1e-10).select(0.0, point)) + " m";
}

/// "3.2 mm", "1.5 m"
inline std::string length_name(double length) {
  return length < 0.5 ? fmt::format("{:.3g} mm", 1e3 * length) : fmt::format("{:.3g} m", length);
}

}  // namespace bielle::reduce
