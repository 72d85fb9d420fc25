// Elimination of a graph of blocks without numbers: who is eliminated before whom, and how much fills in.
//
// References: J. W. H. Liu, SIAM J. Matrix Anal. Appl. 11 (1990) 134 (elimination trees); J. R. Gilbert, E. G. Ng,
// B. W. Peyton, SIAM J. Matrix Anal. Appl. 15 (1994) 1075 (counts of the columns, in nearly linear time).
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/spectral/block_graph.hpp"

namespace bielle {

/// A graph whose blocks are numbered as they are eliminated: `others[starts[b] .. starts[b+1])`, b itself left out.
struct OrderedGraph {
  enum class Side { after, before };  ///< which neighbours: those eliminated later, or earlier
  std::vector<int> starts, others;

  OrderedGraph(const BlockGraph& graph, const std::vector<int>& order, Side side);
};

/// The tree in which the parent of a block is the first other block that its column of L has a number in.
struct BlockElimination {
  std::vector<int> order;             ///< an order that fills in as much, children right before their parents
  std::vector<int> parents;           ///< of the k-th in that order; -1: a root
  std::vector<std::int64_t> counts;   ///< unknowns in the first column of its block of L, its own included
  std::vector<std::int64_t> weights;  ///< unknowns of the k-th

  BlockElimination(const BlockGraph& graph, const std::vector<int>& given_order);
};

/// Numbers of a forest's members in an order in which subtrees stay together, children before parents.
std::vector<int> postorder(const std::vector<int>& parents);

}  // namespace bielle
