#include "reduce/sparse/block_graph.hpp"

#include <algorithm>
#include <numeric>

namespace bielle {

BlockGraph block_graph(const SymmetricMatrix& a, std::span<const std::int64_t> block_starts) {
  BlockGraph graph;
  graph.first.assign(block_starts.begin(), block_starts.end());
  if (block_starts.empty()) {
    graph.first.resize(static_cast<std::size_t>(a.size) + 1);
    std::iota(graph.first.begin(), graph.first.end(), 0);
  }
  const int blocks = static_cast<int>(graph.first.size()) - 1;
  std::vector<int> block_of(static_cast<std::size_t>(a.size)), seen_by(static_cast<std::size_t>(blocks), -1);
  for (int b = 0; b < blocks; ++b)
    std::fill_n(block_of.begin() + graph.first[static_cast<std::size_t>(b)], graph.weight(b), b);
  graph.starts.reserve(static_cast<std::size_t>(blocks) + 1);
  for (int b = 0; b < blocks; ++b) {
    const auto begin = static_cast<std::size_t>(a.starts[static_cast<std::size_t>(graph.first[b])]);
    const auto end = static_cast<std::size_t>(a.starts[static_cast<std::size_t>(graph.first[b + 1])]);
    for (std::size_t p = begin; p < end; ++p) {
      const int i = block_of[static_cast<std::size_t>(a.rows[p])];
      if (seen_by[static_cast<std::size_t>(i)] == b) continue;
      seen_by[static_cast<std::size_t>(i)] = b;
      graph.rows.push_back(i);
    }
    std::sort(graph.rows.begin() + graph.starts.back(), graph.rows.end());
    graph.starts.push_back(static_cast<int>(graph.rows.size()));
  }
  return graph;
}

}  // namespace bielle
