#include "reduce/fe/node_graph.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "reduce/mesh/solid_cells.hpp"

namespace bielle::reduce {

namespace {

/// Cells of each node: `cells[starts[a] .. starts[a+1])`.
struct CellsOfNodes {
  std::vector<std::int64_t> starts;
  std::vector<int> cells;
};

CellsOfNodes cells_of_nodes(const SolidCells& cells, Eigen::Index points) {
  CellsOfNodes result;
  result.starts.assign(points + 1, 0);
  for (int e = 0; e < cells.size(); ++e) {
    for (const int a : cells.nodes(e)) {
      ++result.starts[a + 1];
    }
  }
  for (Eigen::Index a = 0; a < points; ++a) {
    result.starts[a + 1] += result.starts[a];
  }
  result.cells.resize(result.starts.back());
  std::vector<std::int64_t> next(result.starts.begin(), result.starts.end() - 1);
  for (int e = 0; e < cells.size(); ++e) {
    for (const int a : cells.nodes(e)) {
      result.cells[next[a]++] = e;
    }
  }
  return result;
}

/// Computes y = sum_k factors[k] x_k, for some of the entries of each row x_k. @param rows  numbers of the rows, which
/// are `stride` apart
template <int width>
void set_sum_of_rows(std::span<const double> factors, const int* rows, const double* x, Eigen::Index stride,
                     double* y) {
  using Row = Eigen::Array<double, width, 1>;
  Row sum = Row::Zero();
  for (std::size_t k = 0; k < factors.size(); ++k) sum += factors[k] * Eigen::Map<const Row>(x + rows[k] * stride);
  Eigen::Map<Row> result(y);
  result = sum;
}

}  // namespace

std::int64_t NodeGraph::place(int a, int b) const {
  const auto first = neighbours.begin() + starts[a], last = neighbours.begin() + starts[a + 1];
  return std::lower_bound(first, last, b) - neighbours.begin();
}

NodeGraph node_graph(const Mesh& mesh, int threads) {
  const SolidCells cells(mesh);
  const Eigen::Index points = mesh.point_count();
  const CellsOfNodes around = cells_of_nodes(cells, points);
  std::vector<std::vector<int>> lists(points);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index a = 0; a < points; ++a) {
    std::vector<int>& list = lists[a];
    for (std::int64_t p = around.starts[a]; p < around.starts[a + 1]; ++p) {
      const auto cell = cells.nodes(around.cells[p]);
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

RowMatrix NodeMatrix::multiply(const RowMatrix& x, int rows_per_node, int threads) const {
  RowMatrix y(x.rows(), x.cols());
  multiply_into(x, rows_per_node, y, threads);
  return y;
}

void NodeMatrix::multiply_into(const RowMatrix& x, int rows_per_node, RowMatrix& y, int threads) const {
  const Eigen::Index width = rows_per_node * x.cols();  // numbers that a node owns, consecutive in memory
  constexpr int many = 8;                               // this many numbers stay in registers
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index a = 0; a < graph->size(); ++a) {
    const auto first = static_cast<std::size_t>(graph->starts[a]),
               count = static_cast<std::size_t>(graph->starts[a + 1]) - first;
    const std::span<const double> factors(values.data() + first, count);
    const int* const rows = graph->neighbours.data() + first;
    double* const own = y.data() + a * width;
    Eigen::Index at = 0;
    for (; at + many <= width; at += many) set_sum_of_rows<many>(factors, rows, x.data() + at, width, own + at);
    for (; at < width; ++at) set_sum_of_rows<1>(factors, rows, x.data() + at, width, own + at);
  }
}

}  // namespace bielle::reduce
