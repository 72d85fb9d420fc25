// Points of a mesh in the order of their heights along one direction, to find those near a place.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/sort_unique.hpp"

namespace bielle::reduce {

/// Some points of a mesh. It refers to their coordinates.
class SortedPoints {
 public:
  /// @param nodes  numbers of the points; each may occur several times
  SortedPoints(const Eigen::Matrix3Xd& points, const std::vector<int>& nodes) : points_(points) {
    for (const int node : nodes) sorted_.emplace_back(height(points.col(node)), node);
    sort_unique(sorted_);
  }

  /// Tells whether `is_wanted(node)` holds for a point that is no farther than `distance` from a place [m].
  template <class Wanted>
  bool has_near(const Eigen::Vector3d& place, double distance, const Wanted& is_wanted) const {
    const double middle = height(place);
    auto point = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(middle - distance, -1));
    for (; point != sorted_.end() && point->first <= middle + distance; ++point)
      if ((points_.col(point->second) - place).norm() <= distance && is_wanted(point->second)) return true;
    return false;
  }

 private:
  /// Returns the height along an oblique direction, along which the nodes of no face of a machine part coincide.
  static double height(const Eigen::Vector3d& place) { return Eigen::Vector3d(0.6154, 0.3581, 0.7022).dot(place); }

  const Eigen::Matrix3Xd& points_;
  std::vector<std::pair<double, int>> sorted_;
};

}  // namespace bielle::reduce
