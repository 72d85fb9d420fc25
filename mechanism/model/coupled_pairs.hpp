// Interface of components whose forces act between two of many nodes at a time, in pairs that change during a motion
// (bodies that may touch).
//
// The tangent of such a component is the sum of those of its pairs. Few of the n^2 / 2 pairs of n nodes touch at a
// time: the system's tangent has entries only of those that are near to each other (system/pair_tangents.hpp). The
// component has no unknowns of its own and refers to no other component.
#pragma once

#include <utility>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

/// Takes the derivatives of the forces of pairs.
class PairDerivatives {
 public:
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  virtual ~PairDerivatives() = default;
  /// Adds a pair.
  /// @param a,b  local numbers of two different nodes of the component
  /// @param r    residual of the two nodes
  /// @param K,C  its derivatives by positions and by rates of the two nodes
  virtual void add(int a, int b, const Vector12& r, const Matrix12& K, const Matrix12& C) = 0;

 protected:
  PairDerivatives() = default;
  PairDerivatives(const PairDerivatives&) = default;
  PairDerivatives& operator=(const PairDerivatives&) = default;
};

class CoupledPairs {
 public:
  virtual ~CoupledPairs() = default;
  /// Adds the pairs of nodes that act on each other at a state or may do so after small motions, as local numbers in
  /// any order, possibly repeated. It includes all pairs that `add_pair_tangents` adds at this state.
  virtual void add_near_nodes(const LocalState& state, std::vector<std::pair<int, int>>& near) const = 0;
  /// Adds each pair of nodes that act on each other.
  virtual void add_pair_tangents(const LocalState& state, PairDerivatives& sum) const = 0;

 protected:
  CoupledPairs() = default;
  CoupledPairs(const CoupledPairs&) = default;
  CoupledPairs& operator=(const CoupledPairs&) = default;
};

}  // namespace bielle::mechanism
