#include "reduce/reduction/interior_graph.hpp"

#include <algorithm>

namespace bielle::reduce {

namespace {

/// The columns of `carried` that move each point; they are coupled with its neighbours.
class Carriers {
 public:
  explicit Carriers(const SparseRows& carried) : of_points_(static_cast<std::size_t>(carried.rows() / 3)) {
    for (Eigen::Index row = 0; row < carried.outerSize(); ++row)
      for (SparseRows::InnerIterator entry(carried, row); entry; ++entry)
        of_points_[static_cast<std::size_t>(row / 3)].push_back(static_cast<int>(entry.col()));
  }
  /// Adds the columns that move a point, each once.
  void add(int point, std::vector<int>& columns) const {
    const std::vector<int>& own = of_points_[static_cast<std::size_t>(point)];
    if (own.empty()) return;
    columns.insert(columns.end(), own.begin(), own.end());
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  }

 private:
  std::vector<std::vector<int>> of_points_;
};

/// Returns the columns of `carried` that are coupled with each point.
std::vector<std::vector<int>> pulling_columns(const BlockGraph& points, const SparseRows& carried) {
  std::vector<std::vector<int>> pulling(static_cast<std::size_t>(points.size()));
  if (carried.cols() == 0) return pulling;
  const Carriers carriers(carried);
  for (int b = 0; b < points.size(); ++b) {
    for (int p = points.starts[static_cast<std::size_t>(b)]; p < points.starts[static_cast<std::size_t>(b) + 1]; ++p) {
      const int a = points.rows[static_cast<std::size_t>(p)];
      carriers.add(a, pulling[static_cast<std::size_t>(b)]);
      carriers.add(b, pulling[static_cast<std::size_t>(a)]);
    }
  }
  return pulling;
}

}  // namespace

bool InteriorUnknowns::is_like(const InteriorUnknowns& other) const {
  const auto same = [](const auto* a, const auto* b, Eigen::Index count) { return std::equal(a, a + count, b); };
  return kept == other.kept && carried.rows() == other.carried.rows() && carried.cols() == other.carried.cols() &&
         carried.isCompressed() && other.carried.isCompressed() && carried.nonZeros() == other.carried.nonZeros() &&
         same(carried.outerIndexPtr(), other.carried.outerIndexPtr(), carried.outerSize() + 1) &&
         same(carried.innerIndexPtr(), other.carried.innerIndexPtr(), carried.nonZeros());
}

BlockGraph point_graph(const NodeGraph& graph) {
  BlockGraph result;
  result.starts.reserve(graph.starts.size());
  result.rows.reserve((graph.neighbours.size() + static_cast<std::size_t>(graph.size())) / 2);
  for (int b = 0; b < graph.size(); ++b) {
    result.rows.push_back(b);
    for (auto p = static_cast<std::size_t>(graph.starts[static_cast<std::size_t>(b)]);
         p < static_cast<std::size_t>(graph.starts[static_cast<std::size_t>(b) + 1]); ++p)
      if (graph.neighbours[p] > b) result.rows.push_back(graph.neighbours[p]);
    result.starts.push_back(static_cast<int>(result.rows.size()));
    result.first.push_back(3 * (std::int64_t{b} + 1));
  }
  return result;
}

BlockGraph interior_graph(const BlockGraph& points, const InteriorUnknowns& interior) {
  std::vector<int> block_of(static_cast<std::size_t>(points.size()), -1), point_of;
  BlockGraph result;
  result.first.clear();
  for (std::size_t k = 0; k < interior.kept.size(); ++k) {
    const int point = static_cast<int>(interior.kept[k] / 3);
    if (!point_of.empty() && point_of.back() == point) continue;
    block_of[static_cast<std::size_t>(point)] = static_cast<int>(point_of.size());
    point_of.push_back(point);
    result.first.push_back(static_cast<std::int64_t>(k));
  }
  const int of_points = static_cast<int>(point_of.size()), carried = static_cast<int>(interior.carried.cols());
  for (int c = 0; c <= carried; ++c) result.first.push_back(static_cast<std::int64_t>(interior.kept.size()) + c);

  const std::vector<std::vector<int>> pulling = pulling_columns(points, interior.carried);
  for (const int b : point_of) {
    for (int p = points.starts[static_cast<std::size_t>(b)]; p < points.starts[static_cast<std::size_t>(b) + 1]; ++p)
      if (const int row = block_of[static_cast<std::size_t>(points.rows[static_cast<std::size_t>(p)])]; row >= 0)
        result.rows.push_back(row);
    for (const int c : pulling[static_cast<std::size_t>(b)]) result.rows.push_back(of_points + c);
    result.starts.push_back(static_cast<int>(result.rows.size()));
  }
  for (int c = 0; c < carried; ++c) {
    for (int other = c; other < carried; ++other) result.rows.push_back(of_points + other);
    result.starts.push_back(static_cast<int>(result.rows.size()));
  }
  return result;
}

}  // namespace bielle::reduce
