#include "reduce/spectral/supernodes.hpp"

#include <algorithm>
#include <numeric>

#include "reduce/spectral/block_elimination.hpp"

namespace bielle {

namespace {

std::size_t place(int k) { return static_cast<std::size_t>(k); }

/// Supernodes as a forest, children before parents.
struct Forest {
  std::vector<int> first;                  // block of each in the order of elimination; then the number of blocks
  std::vector<int> parents;                // -1: a root
  std::vector<std::int64_t> width, below;  // unknowns: its own, and the rows below them
};

/// A block goes with the one before it when that is its only child, and both have the same rows.
Forest fundamental_supernodes(const BlockElimination& blocks) {
  const int count = static_cast<int>(blocks.parents.size());
  std::vector<int> children(place(count), 0), supernode_of(place(count));
  for (const int parent : blocks.parents)
    if (parent != -1) ++children[place(parent)];
  Forest forest;
  for (int k = 0; k < count; ++k) {
    const std::size_t at = place(k);
    const bool follows = k > 0 && blocks.parents[at - 1] == k && children[at] == 1 &&
                         blocks.counts[at - 1] - blocks.weights[at - 1] == blocks.counts[at];
    if (!follows) {
      forest.first.push_back(k);
      forest.width.push_back(0);
      forest.below.push_back(0);
    }
    supernode_of[at] = static_cast<int>(forest.first.size()) - 1;
    forest.width.back() += blocks.weights[at];
    forest.below.back() = blocks.counts[at] - blocks.weights[at];
  }
  forest.first.push_back(count);
  for (std::size_t s = 0; s < forest.width.size(); ++s) {
    const int parent = blocks.parents[place(forest.first[s + 1]) - 1];
    forest.parents.push_back(parent == -1 ? -1 : supernode_of[place(parent)]);
  }
  return forest;
}

/// Whether a supernode of so many columns may hold such a share of zeros.
bool is_worth_merging(std::int64_t width, double zeros) {
  constexpr std::int64_t tiny = 8, small = 24, medium = 96;
  return width <= tiny || (width <= small && zeros < 0.3) || (width <= medium && zeros < 0.1) || zeros < 0.02;
}

/// Children that go with their parent, in which zeros are then stored. @returns  for each the supernode that it is in
std::vector<int> merge_small(Forest& forest) {
  const int count = static_cast<int>(forest.width.size());
  std::vector<std::vector<int>> children(place(count));
  for (int s = 0; s < count; ++s)
    if (forest.parents[place(s)] != -1) children[place(forest.parents[place(s)])].push_back(s);
  std::vector<double> zeros(place(count), 0);
  std::vector<int> goes_with(place(count));
  std::iota(goes_with.begin(), goes_with.end(), 0);
  for (int s = 0; s < count; ++s) {
    std::int64_t& width = forest.width[place(s)];
    const std::int64_t below = forest.below[place(s)];
    const auto missing = [&](int c) {  // rows of the parent that a child has not
      return static_cast<double>(forest.width[place(c)]) * static_cast<double>(width + below - forest.below[place(c)]);
    };
    std::vector<int>& own = children[place(s)];
    std::stable_sort(own.begin(), own.end(), [&](int a, int b) { return missing(a) < missing(b); });
    for (const int c : own) {
      const std::int64_t together = width + forest.width[place(c)];
      const double n = static_cast<double>(together), sum = zeros[place(s)] + zeros[place(c)] + missing(c);
      if (!is_worth_merging(together, sum / (n * (n + 1) / 2 + n * static_cast<double>(below)))) continue;
      width = together;
      zeros[place(s)] = sum;
      goes_with[place(c)] = s;
    }
  }
  for (int s = count - 1; s >= 0; --s) goes_with[place(s)] = goes_with[place(goes_with[place(s)])];
  return goes_with;
}

/// What is merged, as it is eliminated: `order` of blocks (numbers in the order so far).
struct MergedForest {
  std::vector<int> order, first, parents;
};

MergedForest merged_forest(const Forest& forest, const std::vector<int>& goes_with) {
  const int count = static_cast<int>(forest.width.size());
  std::vector<int> number(place(count), -1), tops;
  for (int s = 0; s < count; ++s) {
    if (goes_with[place(s)] != s) continue;
    number[place(s)] = static_cast<int>(tops.size());
    tops.push_back(s);
  }
  std::vector<std::vector<int>> members(tops.size());
  for (int s = 0; s < count; ++s) members[place(number[place(goes_with[place(s)])])].push_back(s);
  std::vector<int> parents;
  for (const int top : tops) {
    const int parent = forest.parents[place(top)];
    parents.push_back(parent == -1 ? -1 : number[place(goes_with[place(parent)])]);
  }
  const std::vector<int> sequence = postorder(parents);
  std::vector<int> places(sequence.size());
  for (std::size_t k = 0; k < sequence.size(); ++k) places[place(sequence[k])] = static_cast<int>(k);
  MergedForest merged;
  for (const int group : sequence) {
    merged.first.push_back(static_cast<int>(merged.order.size()));
    merged.parents.push_back(parents[place(group)] == -1 ? -1 : places[place(parents[place(group)])]);
    for (const int s : members[place(group)])
      for (int block = forest.first[place(s)]; block < forest.first[place(s) + 1]; ++block)
        merged.order.push_back(block);
  }
  merged.first.push_back(static_cast<int>(merged.order.size()));
  return merged;
}

/// The blocks below each supernode, ascending: those its own are coupled with, and those its children leave.
std::vector<std::vector<int>> blocks_below(const OrderedGraph& after, const MergedForest& forest) {
  const std::size_t count = forest.parents.size();
  std::vector<std::vector<int>> below(count), children(count);
  std::vector<int> seen_by(forest.order.size(), -1);
  for (std::size_t s = 0; s < count; ++s) {
    const int own = forest.first[s], end = forest.first[s + 1];
    const auto take = [&](int row) {
      if (row < end || seen_by[place(row)] == static_cast<int>(s)) return;
      seen_by[place(row)] = static_cast<int>(s);
      below[s].push_back(row);
    };
    for (int p = after.starts[place(own)]; p < after.starts[place(end)]; ++p) take(after.others[place(p)]);
    for (const int child : children[s])
      for (const int row : below[place(child)]) take(row);
    std::sort(below[s].begin(), below[s].end());
    if (forest.parents[s] != -1) children[place(forest.parents[s])].push_back(static_cast<int>(s));
  }
  return below;
}

void count_numbers(const BlockElimination& blocks, Supernodes& result) {
  for (std::size_t k = 0; k < blocks.counts.size(); ++k) {
    for (std::int64_t c = 0; c < blocks.weights[k]; ++c) {
      const std::int64_t count = blocks.counts[k] - c;
      result.nonzeros += count;
      result.flops += static_cast<double>(count) * static_cast<double>(count);
    }
  }
}

}  // namespace

Supernodes find_supernodes(const BlockGraph& graph, const std::vector<int>& order, bool merged) {
  const BlockElimination blocks(graph, order);
  Forest fundamental = fundamental_supernodes(blocks);
  std::vector<int> goes_with(fundamental.width.size());
  std::iota(goes_with.begin(), goes_with.end(), 0);
  if (merged) goes_with = merge_small(fundamental);
  const MergedForest forest = merged_forest(fundamental, goes_with);

  std::vector<int> final_order;
  for (const int k : forest.order) final_order.push_back(blocks.order[place(k)]);
  const std::vector<std::vector<int>> below =
      blocks_below(OrderedGraph(graph, final_order, OrderedGraph::Side::after), forest);

  Supernodes result;
  count_numbers(blocks, result);
  std::vector<std::int64_t> first_row{0};  // of each block in L
  for (const int block : final_order) {
    for (std::int64_t c = 0; c < graph.weight(block); ++c) result.order.push_back(graph.first[place(block)] + c);
    first_row.push_back(static_cast<std::int64_t>(result.order.size()));
  }
  result.columns = result.row_starts = result.value_starts = {0};
  for (std::size_t s = 0; s < below.size(); ++s) {
    const std::int64_t begin = first_row[place(forest.first[s])], end = first_row[place(forest.first[s + 1])];
    for (std::int64_t row = begin; row < end; ++row) result.rows.push_back(row);
    for (const int block : below[s])
      for (std::int64_t row = first_row[place(block)]; row < first_row[place(block) + 1]; ++row)
        result.rows.push_back(row);
    result.columns.push_back(end);
    const auto stored = static_cast<std::int64_t>(result.rows.size());
    result.value_starts.push_back(result.value_starts.back() + (end - begin) * (stored - result.row_starts.back()));
    result.row_starts.push_back(stored);
  }
  return result;
}

}  // namespace bielle
