#include "reduce/spectral/elimination_tree.hpp"

#include <algorithm>
#include <queue>
#include <utility>

#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

namespace {

constexpr double flops_of_a_thread = 2e7;
constexpr int parts_of_a_thread = 4;  // subtrees are no larger than such a part of what a thread has to do

double elimination_work(double width, double below) {
  return width * width * width / 3 + width * width * below + width * below * below;
}

}  // namespace

EliminationTree::EliminationTree(const SupernodalFactor& structure) {
  const auto count = static_cast<std::size_t>(structure.supernodes);
  std::vector<std::int64_t> owner(static_cast<std::size_t>(structure.size));
  for (std::size_t s = 0; s < count; ++s)
    std::fill(owner.begin() + structure.columns[s], owner.begin() + structure.columns[s + 1],
              static_cast<std::int64_t>(s));
  parents.assign(count, -1);
  children.resize(count);
  work.assign(count, 0);
  for (std::size_t s = 0; s < count; ++s) {
    const std::int64_t width = structure.columns[s + 1] - structure.columns[s];
    const std::int64_t first_below = structure.row_starts[s] + width;
    const std::int64_t below = structure.row_starts[s + 1] - first_below;
    work[s] += elimination_work(static_cast<double>(width), static_cast<double>(below));
    if (below == 0) continue;
    parents[s] = owner[static_cast<std::size_t>(structure.rows[first_below])];
    const auto parent = static_cast<std::size_t>(parents[s]);
    work[parent] += work[s];
    children[parent].push_back(static_cast<std::int64_t>(s));
  }
}

TreeShares share_out(const EliminationTree& tree, std::span<const double> work, double worth_a_thread, int threads) {
  const std::size_t count = tree.parents.size();
  using Subtree = std::pair<double, std::int64_t>;  // work, root
  std::priority_queue<Subtree> subtrees;
  double all = 0;
  for (std::size_t s = 0; s < count; ++s) {
    if (tree.parents[s] >= 0) continue;
    subtrees.emplace(work[s], static_cast<std::int64_t>(s));
    all += work[s];
  }
  TreeShares shares;
  shares.threads = static_cast<int>(std::clamp(all / worth_a_thread, 1.0, static_cast<double>(std::max(1, threads))));
  shares.is_above.assign(count, false);
  const double small = all / (parts_of_a_thread * shares.threads);
  while (shares.threads > 1 && !subtrees.empty() && subtrees.top().first > small) {
    const auto root = static_cast<std::size_t>(subtrees.top().second);
    subtrees.pop();
    shares.is_above[root] = true;
    for (const std::int64_t child : tree.children[root]) subtrees.emplace(work[static_cast<std::size_t>(child)], child);
  }
  for (; !subtrees.empty(); subtrees.pop()) shares.roots.push_back(subtrees.top().second);
  return shares;
}

TreeShares share_out(const EliminationTree& tree, int threads) {
  return share_out(tree, tree.work, flops_of_a_thread, threads);
}

}  // namespace bielle
