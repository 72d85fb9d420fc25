// The elimination tree of supernodes: who takes what from whom, and what can be eliminated at the same time.
#pragma once

#include <cstdint>
#include <span>
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

/// Subtrees that threads work on one by one, and what all of them work on together.
struct TreeShares {
  int threads = 1;                  ///< that are worth their while
  std::vector<std::int64_t> roots;  ///< of the subtrees, those with most work first
  std::vector<bool> is_above;       ///< of each supernode: above the subtrees
};

/// Cuts the largest subtree off its root until there are enough. Small trees, and one thread, have nothing above.
/// @param work            of the subtree of each supernode
/// @param worth_a_thread  how much of it is worth another thread
TreeShares share_out(const EliminationTree& tree, std::span<const double> work, double worth_a_thread, int threads);
/// By the work of the elimination.
TreeShares share_out(const EliminationTree& tree, int threads);

}  // namespace bielle
