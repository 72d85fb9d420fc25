// The part of a component of pairs (CoupledPairs) in the global tangent: entries of the pairs that are near.
//
// Each node has a block on the diagonal, and each near pair two blocks off it, along the independent increments of
// the nodes or their carriers. The time of an evaluation and the memory are in proportion to the numbers of nodes and
// of near pairs.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mechanism/math/sparse_pattern.hpp"
#include "mechanism/model/coupled_pairs.hpp"
#include "mechanism/system/member_tangent.hpp"

namespace bielle::mechanism {

class PairTangents {
 public:
  /// No pair is near at first. The object keeps references to its arguments.
  PairTangents(const CoupledPairs& component, const NodeKinematics& kinematics, const Slots& slots);

  /// Takes the pairs that are near at a state. Earlier ones are kept unless they are many.
  void choose(const LocalState& state);
  /// Discards all pairs.
  void forget() { near_.clear(); }
  std::size_t count() const { return near_.size(); }  ///< number of near pairs of nodes

  /// Calls act(row, column, lasting) for each entry: those between two nodes do not last, because they are zero while
  /// the nodes do not act on each other.
  template <class Act>
  void for_each_entry(const Act& act) const {
    const auto add_block = [&](const Part& rows, const Part& columns, bool lasting) {
      for (int column = columns.begin; column < columns.begin + columns.count; ++column)
        for (int row = rows.begin; row < rows.begin + rows.count; ++row) act(row, column, lasting);
    };
    for (const Part& part : parts_) add_block(part, part, true);
    for (const Near& pair : near_) {
      add_block(part(pair.a), part(pair.b), false);
      add_block(part(pair.b), part(pair.a), false);
    }
  }
  /// Finds the places of all entries in the pattern, which contains them.
  void find_places(const SparsePattern& pattern);
  /// Adds the tangent at a state to the values of the global one.
  /// @returns false if two nodes that are no near pair act on each other: the sum is then not complete
  bool add(const LocalState& state, const TangentRequest& request, std::vector<double>& values) const;

 private:
  using Columns = std::array<int, 6>;  ///< for each column of a block, the place of its first row
  /// A node of the component: its unknowns or those of its carrier, and its block on the diagonal.
  struct Part {
    int node, begin, count;
    Columns diagonal;
  };
  /// Two nodes, the smaller local number first. Block ab has the rows of a and the columns of b.
  struct Near {
    int a, b;
    Columns ab, ba;
  };
  class Sum;
  const Part& part(int node) const { return parts_[static_cast<std::size_t>(node)]; }
  const Near* find(int a, int b) const;

  const CoupledPairs& component_;
  const NodeKinematics& kinematics_;
  bool plain_;  ///< whether every node is free in all six directions, or held in all
  std::vector<Part> parts_;
  std::vector<Near> near_;  ///< ascending
};

}  // namespace bielle::mechanism
