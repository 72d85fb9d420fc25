// Which pairs of many shapes are near to each other: balls around the shapes, swept along one axis.
//
// Sorted by their lower ends along x, each ball is compared with those that begin before it ends. Planes are compared
// with all. The cost is that of sorting, and of the pairs whose ranges along x overlap; the memory
// that of the pairs that count.
#pragma once

#include <cstddef>
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
  /// Of the pair of two shapes, -1: does not count.
  int number(int a, int b) const;
  struct Partner {
    int shape, pair;
  };
  int shapes_ = 0;
  std::vector<Partner> partners_;   ///< by the smaller number of each pair, then ascending
  std::vector<std::size_t> begin_;  ///< of each shape, and one behind the last: its partners
};

}  // namespace bielle::mechanism
