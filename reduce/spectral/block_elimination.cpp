#include "reduce/spectral/block_elimination.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace bielle {

namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> places(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) places[at(order[k])] = static_cast<int>(k);
  return places;
}

/// Parents: each block, as it comes, ends the chains of those before it that it is coupled with.
std::vector<int> elimination_parents(const OrderedGraph& before) {
  const int blocks = static_cast<int>(before.starts.size()) - 1;
  std::vector<int> parents(at(blocks), -1), ancestors(at(blocks), -1);
  for (int k = 0; k < blocks; ++k) {
    for (int p = before.starts[at(k)]; p < before.starts[at(k) + 1]; ++p) {
      for (int i = before.others[at(p)]; i != -1 && i < k;) {
        const int next = ancestors[at(i)];
        ancestors[at(i)] = k;
        if (next == -1) parents[at(i)] = k;
        i = next;
      }
    }
  }
  return parents;
}

/// The roots of trees that grow together, paths being shortened as they are walked.
class Ancestors {
 public:
  explicit Ancestors(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0); }
  void join(int child, int parent) { up_[at(child)] = parent; }
  int root(int of) {
    int root = of;
    while (up_[at(root)] != root) root = up_[at(root)];
    while (up_[at(of)] != root) of = std::exchange(up_[at(of)], root);
    return root;
  }

 private:
  std::vector<int> up_;
};

/// Row i of L has numbers in the columns of a subtree whose root is i: i counts once at each of its leaves, and not
/// again where paths from two of them meet, nor above i.
std::vector<std::int64_t> column_counts(const OrderedGraph& after, const std::vector<int>& parents,
                                        const std::vector<std::int64_t>& weights) {
  const int blocks = static_cast<int>(parents.size());
  std::vector<int> first_descendant(at(blocks), -1), last_leaf(at(blocks), -1), leaf_reached(at(blocks), -1);
  std::vector<std::int64_t> counts(at(blocks), 0);
  for (int j = 0; j < blocks; ++j) {
    if (first_descendant[at(j)] == -1) counts[at(j)] += weights[at(j)];  // a leaf of the whole tree
    for (int up = j; up != -1 && first_descendant[at(up)] == -1; up = parents[at(up)]) first_descendant[at(up)] = j;
  }
  Ancestors ancestors(at(blocks));
  for (int j = 0; j < blocks; ++j) {
    const int parent = parents[at(j)];
    if (parent != -1) counts[at(parent)] -= weights[at(j)];
    for (int p = after.starts[at(j)]; p < after.starts[at(j) + 1]; ++p) {
      const int i = after.others[at(p)];
      if (first_descendant[at(j)] <= leaf_reached[at(i)]) continue;  // no leaf of the subtree of row i
      leaf_reached[at(i)] = first_descendant[at(j)];
      counts[at(j)] += weights[at(i)];
      if (last_leaf[at(i)] != -1) counts[at(ancestors.root(last_leaf[at(i)]))] -= weights[at(i)];
      last_leaf[at(i)] = j;
    }
    if (parent != -1) ancestors.join(j, parent);
  }
  for (int j = 0; j < blocks; ++j)
    if (parents[at(j)] != -1) counts[at(parents[at(j)])] += counts[at(j)];
  return counts;
}

}  // namespace

OrderedGraph::OrderedGraph(const BlockGraph& graph, const std::vector<int>& order, Side side)
    : starts(order.size() + 1, 0), others(graph.rows.size() - order.size()) {
  const std::vector<int> places = inverse(order);
  const auto each = [&](const auto& work) {
    for (int b = 0; b < graph.size(); ++b) {
      for (int p = graph.starts[at(b)] + 1; p < graph.starts[at(b) + 1]; ++p) {
        const int a = places[at(b)], c = places[at(graph.rows[at(p)])];
        side == Side::after ? work(std::min(a, c), std::max(a, c)) : work(std::max(a, c), std::min(a, c));
      }
    }
  };
  each([&](int own, int) { ++starts[at(own) + 1]; });
  for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
  std::vector<int> next(starts.begin(), starts.end() - 1);
  each([&](int own, int other) { others[at(next[at(own)]++)] = other; });
}

std::vector<int> postorder(const std::vector<int>& parents) {
  const int count = static_cast<int>(parents.size());
  std::vector<int> first_child(at(count), -1), sibling(at(count), -1), order, waiting;
  int first_root = -1;
  for (int k = count - 1; k >= 0; --k) {
    int& first = parents[at(k)] == -1 ? first_root : first_child[at(parents[at(k)])];
    sibling[at(k)] = std::exchange(first, k);
  }
  order.reserve(at(count));
  for (int next = first_root; next != -1;) {
    while (first_child[at(next)] != -1) {
      waiting.push_back(next);
      next = first_child[at(next)];
    }
    order.push_back(next);
    while (sibling[at(next)] == -1 && !waiting.empty()) {
      next = waiting.back();
      waiting.pop_back();
      order.push_back(next);
    }
    next = sibling[at(next)];
  }
  return order;
}

BlockElimination::BlockElimination(const BlockGraph& graph, const std::vector<int>& given_order) {
  const std::vector<int> given_parents =
      elimination_parents(OrderedGraph(graph, given_order, OrderedGraph::Side::before));
  const std::vector<int> renumbered = postorder(given_parents), places = inverse(renumbered);
  for (const int k : renumbered) {
    order.push_back(given_order[at(k)]);
    parents.push_back(given_parents[at(k)] == -1 ? -1 : places[at(given_parents[at(k)])]);
    weights.push_back(graph.weight(order.back()));
  }
  counts = column_counts(OrderedGraph(graph, order, OrderedGraph::Side::after), parents, weights);
}

}  // namespace bielle
