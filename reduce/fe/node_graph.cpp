#include "reduce/fe/node_graph.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "reduce/spectral/few_vectors.hpp"

namespace bielle::reduce {

namespace {

/// Cells of each node: `cells[starts[a] .. starts[a+1])`.
struct CellsOfNodes {
  std::vector<std::int64_t> starts;
  std::vector<int> cells;
};

CellsOfNodes cells_of_nodes(const Eigen::MatrixXi& nodes, Eigen::Index points) {
  CellsOfNodes result;
  result.starts.assign(points + 1, 0);
  for (const int a : nodes.reshaped()) {
    ++result.starts[a + 1];
  }
  for (Eigen::Index a = 0; a < points; ++a) {
    result.starts[a + 1] += result.starts[a];
  }
  result.cells.resize(nodes.size());
  std::vector<std::int64_t> next(result.starts.begin(), result.starts.end() - 1);
  for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
    for (const int a : nodes.col(e)) {
      result.cells[next[a]++] = static_cast<int>(e);
    }
  }
  return result;
}

}  // namespace

std::int64_t NodeGraph::place(int a, int b) const {
  const auto first = neighbours.begin() + starts[a], last = neighbours.begin() + starts[a + 1];
  return std::lower_bound(first, last, b) - neighbours.begin();
}

NodeGraph node_graph(const Eigen::MatrixXi& nodes, Eigen::Index points, int threads) {
  const CellsOfNodes around = cells_of_nodes(nodes, points);
  std::vector<std::vector<int>> lists(points);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index a = 0; a < points; ++a) {
    std::vector<int>& list = lists[a];
    for (std::int64_t p = around.starts[a]; p < around.starts[a + 1]; ++p) {
      const auto cell = nodes.col(around.cells[p]);
      list.insert(list.end(), cell.begin(), cell.end());
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  NodeGraph graph;
  graph.starts.reserve(points + 1);
  std::int64_t total = 0;
  for (const auto& list : lists) {
    graph.starts.push_back(total += static_cast<std::int64_t>(list.size()));
  }
  graph.neighbours.reserve(total);
  for (const auto& list : lists) {
    graph.neighbours.insert(graph.neighbours.end(), list.begin(), list.end());
  }
  return graph;
}

std::vector<std::vector<int>> colour_cells(const Eigen::MatrixXi& nodes, Eigen::Index points) {
  constexpr std::size_t words = 8;
  using Colours = std::array<std::uint64_t, words>;
  std::vector<Colours> used(points, Colours{});
  std::vector<std::vector<int>> cells;
  for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
    Colours taken{};
    for (const int a : nodes.col(e)) {
      for (std::size_t w = 0; w < words; ++w) {
        taken[w] |= used[a][w];
      }
    }
    std::size_t colour = 0;
    while (colour < 64 * words && (taken[colour / 64] >> (colour % 64) & 1)) {
      ++colour;
    }
    if (colour == 64 * words) {
      throw std::length_error("a node of the mesh belongs to too many cells");
    }
    for (const int a : nodes.col(e)) {
      used[a][colour / 64] |= std::uint64_t{1} << (colour % 64);
    }
    cells.resize(std::max(cells.size(), colour + 1));
    cells[colour].push_back(static_cast<int>(e));
  }
  return cells;
}

namespace {

/// y = m x with `width` consecutive numbers per node, a multiple of `vectors_abreast`.
void multiply_many(const NodeMatrix& m, const double* x, double* y, int width, int threads) {
  const NodeGraph& graph = *m.graph;
  const FewVectors& kernels = FewVectors::fastest();
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index a = 0; a < graph.size(); ++a) {
    const std::int64_t first = graph.starts[a];
    kernels.weighted_sum(graph.starts[a + 1] - first, m.values.data() + first, graph.neighbours.data() + first, x,
                         width, y + a * width);
  }
}

/// The same for any width; one known to the compiler stays in registers.
template <int fixed_width>
void multiply_nodes(const NodeMatrix& m, const double* x, double* y, Eigen::Index width, int threads) {
  using Numbers = Eigen::Array<double, fixed_width, 1>;
  const NodeGraph& graph = *m.graph;
#pragma omp parallel num_threads(threads)
  {
    Numbers sum(width);
#pragma omp for schedule(static)
    for (Eigen::Index a = 0; a < graph.size(); ++a) {
      sum.setZero();
      for (std::int64_t p = graph.starts[a]; p < graph.starts[a + 1]; ++p)
        sum += m.values[p] * Eigen::Map<const Numbers>(x + graph.neighbours[p] * width, width);
      Eigen::Map<Numbers>(y + a * width, width) = sum;
    }
  }
}

}  // namespace

RowMatrix NodeMatrix::multiply(const RowMatrix& x, int rows_per_node, int threads) const {
  RowMatrix y(x.rows(), x.cols());
  multiply_into(x, rows_per_node, y, threads);
  return y;
}

void NodeMatrix::multiply_into(const RowMatrix& x, int rows_per_node, RowMatrix& y, int threads) const {
  const Eigen::Index width = rows_per_node * x.cols();  // numbers that a node owns, consecutive in memory
  if (width % vectors_abreast == 0) return multiply_many(*this, x.data(), y.data(), static_cast<int>(width), threads);
  width == 3 ? multiply_nodes<3>(*this, x.data(), y.data(), width, threads)
             : multiply_nodes<Eigen::Dynamic>(*this, x.data(), y.data(), width, threads);
}

}  // namespace bielle::reduce
