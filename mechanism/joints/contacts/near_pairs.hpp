// Which pairs of many shapes are near to each other: balls around the shapes, swept along one axis.
//
// Sorted by their lower ends along x, each ball is compared with those that begin before it ends. Planes are compared
// with all. The cost is that of sorting, and of the pairs whose ranges along x overlap.
#pragma once

#include <utility>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class NearPairs {
 public:
  /// Half of what is on the outer side of a plane.
  struct Bound {
    Vector3 middle = Vector3::Zero();
    double reach = 0;                  ///< infinite: a plane
    Vector3 normal = Vector3::Zero();  ///< of a plane
  };
  NearPairs() = default;
  /// @param shapes  their number @param pairs  that count, the smaller number first
  NearPairs(int shapes, const std::vector<std::pair<int, int>>& pairs);
  /// Numbers of the pairs whose bounds overlap, ascending.
  /// @param bounds  of all shapes
  void find(const std::vector<Bound>& bounds, std::vector<int>& near) const;
  /// A lower bound of the gap of two shapes [m].
  static double apart(const Bound& a, const Bound& b);

 private:
  int number(int a, int b) const {
    return a < b
               ? number_[static_cast<std::size_t>(a) * static_cast<std::size_t>(shapes_) + static_cast<std::size_t>(b)]
               : number_[static_cast<std::size_t>(b) * static_cast<std::size_t>(shapes_) + static_cast<std::size_t>(a)];
  }
  int shapes_ = 0;
  std::vector<int> number_;  ///< of each pair of shapes, -1: does not count
};

}  // namespace bielle::mechanism
