// The elimination tree of supernodes: who takes what from whom, and what can be eliminated at the same time.
#pragma once

#include <cstdint>
#include <vector>

namespace bielle {

struct SupernodalFactor;

/// Supernodes are numbered so that parents come after their children.
struct EliminationTree {
  std::vector<std::int64_t> parents;                ///< -1: a root
  std::vector<std::vector<std::int64_t>> children;  ///< ascending
  std::vector<double> work;                         ///< of the whole subtree [flops]

  explicit EliminationTree(const SupernodalFactor& structure);
};

/// Subtrees that threads eliminate one by one, and what all of them eliminate together.
struct TreeShares {
  std::vector<std::int64_t> roots;  ///< of the subtrees, those with most work first
  std::vector<bool> is_above;       ///< of each supernode: above the subtrees
};

/// Cuts the largest subtree off its root until there are enough. Small trees, and one thread, have nothing above.
TreeShares share_out(const EliminationTree& tree, int threads);

}  // namespace bielle
