// Finds the pairs of many shapes that are near to each other: bounding spheres, swept along one axis.
//
// Spheres are sorted by their lower ends along x; each is compared with those that begin before it ends. Planes are
// compared with all shapes. The cost is that of sorting, and of the pairs whose ranges along x overlap; the memory is
// that of the pairs of interest.
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
  /// A lower bound of the gap of two shapes [m].
  static double apart(const Bound& a, const Bound& b);

 private:
  /// Number of the pair of two shapes, -1: not of interest.
  int number(int a, int b) const;
  struct Partner {
    int shape, pair;
  };
  int shapes_ = 0;
  std::vector<Partner> partners_;   ///< sorted by the smaller number of each pair, then ascending
  std::vector<std::size_t> begin_;  ///< first partner of each shape, and one past the last
};

}  // namespace bielle::mechanism
