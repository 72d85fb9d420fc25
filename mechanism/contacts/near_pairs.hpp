// Finds the pairs of many shapes that are near to each other: bounding spheres, swept along one axis.
//
// Spheres are sorted by their lower ends along the axis in which they are spread most; each is compared with those that
// begin before it ends. Planes are compared with all shapes. The cost is that of sorting, and of the pairs whose ranges
// along the axis overlap; the memory is that of the pairs of interest.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class NearPairs {
 public:
  /// A bounding sphere, or the half-space below a plane.
  struct Bound {
    Vector3 middle = Vector3::Zero();
    double reach = 0;                  ///< radius; infinite for a plane
    Vector3 normal = Vector3::Zero();  ///< outward normal of a plane
  };
  NearPairs() = default;
  /// @param shapes  number of shapes @param pairs  pairs of interest, the smaller number first
  NearPairs(int shapes, const std::vector<std::pair<int, int>>& pairs);
  /// Finds the numbers of the pairs whose bounds overlap, ascending.
  /// @param bounds  bounds of all shapes
  void find(const std::vector<Bound>& bounds, std::vector<int>& near) const;
  /// Calls act(pair) for each pair whose bounds are no farther apart than a distance, in no particular order.
  /// @param bounds    bounds of all shapes
  /// @param distance  `act` may reduce it meanwhile [m]
  template <class Act>
  void for_each_within(const std::vector<Bound>& bounds, const double& distance, const Act& act) const;
  /// Returns a lower bound of the gap of two shapes [m].
  static double apart(const Bound& a, const Bound& b);

 private:
  /// The range of a sphere along the axis.
  struct Range {
    double low, high;
    int shape;
  };
  struct Sorted {
    std::vector<Range> ranges;  ///< by their lower ends
    std::vector<int> planes;
  };
  /// The reference is valid until the next call in the same thread.
  const Sorted& sort(const std::vector<Bound>& bounds) const;
  /// Number of the pair of two shapes, -1: not of interest.
  int number(int a, int b) const;
  struct Partner {
    int shape, pair;
  };
  int shapes_ = 0;
  std::vector<Partner> partners_;   ///< sorted by the smaller number of each pair, then ascending
  std::vector<std::size_t> begin_;  ///< first partner of each shape, and one past the last
};

template <class Act>
void NearPairs::for_each_within(const std::vector<Bound>& bounds, const double& distance, const Act& act) const {
  const Sorted& sorted = sort(bounds);
  const auto take = [&](int a, int b) {
    if (const int pair = number(a, b); pair >= 0) act(pair);
  };
  for (std::size_t k = 0; k < sorted.ranges.size(); ++k) {
    const Range& range = sorted.ranges[k];
    const Bound& one = bounds[static_cast<std::size_t>(range.shape)];
    for (std::size_t l = k + 1; l < sorted.ranges.size() && sorted.ranges[l].low <= range.high + distance; ++l) {
      const Bound& other = bounds[static_cast<std::size_t>(sorted.ranges[l].shape)];
      const double most = one.reach + other.reach + distance;
      if (most >= 0 && (one.middle - other.middle).squaredNorm() <= most * most)
        take(range.shape, sorted.ranges[l].shape);
    }
    for (const int plane : sorted.planes)
      if (apart(bounds[static_cast<std::size_t>(plane)], one) <= distance) take(range.shape, plane);
  }
}

}  // namespace bielle::mechanism
