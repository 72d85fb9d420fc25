// Sets of connected objects, which are joined step by step.
#pragma once

#include <numeric>
#include <vector>

namespace bielle::reduce {

/// Disjoint sets of numbers from 0, joined pair by pair.
class DisjointSets {
 public:
  explicit DisjointSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  /// Returns a number that represents the set of i; it is the same for all members.
  int of(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) { parent_[of(i)] = of(j); }

 private:
  std::vector<int> parent_;
};

}  // namespace bielle::reduce
