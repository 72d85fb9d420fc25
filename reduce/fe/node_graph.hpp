// The graph of nodes that share a cell: the pattern of every finite-element matrix.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/mesh.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// Neighbours of node a, itself included, ascending: `neighbours[starts[a] .. starts[a+1])`. Nodes without cells have
/// no neighbours.
struct NodeGraph {
  std::vector<std::int64_t> starts{0};
  std::vector<int> neighbours;

  Eigen::Index size() const { return static_cast<Eigen::Index>(starts.size()) - 1; }
  /// Position of node b in the list of node a, which must be its neighbour.
  std::int64_t place(int a, int b) const;
};

/// Positions of the blocks of one cell: positions in the graph of pairs of its nodes, found by one pass over the
/// neighbours of each node.
template <int N>
class CellPlaces {
 public:
  /// @param nodes  (nodes of a cell, cells)
  CellPlaces(const NodeGraph& graph, const Eigen::MatrixXi& nodes, Eigen::Index cell) : graph_(graph) {
    for (int a = 0; a < N; ++a) {
      nodes_[a] = nodes(a, cell);
      int k = a;
      for (; k > 0 && nodes_[order_[k - 1]] > nodes_[a]; --k) order_[k] = order_[k - 1];
      order_[k] = a;
    }
  }
  /// Visits each node b of the cell that has at least the number of node a (local numbers), with its position among the
  /// neighbours of node a.
  /// @param own  position of node a itself @param visit  (b, position)
  template <class Visit>
  void from(int a, std::int64_t own, const Visit& visit) const {
    walk(own, nodes_[a], visit);
  }
  /// Visits all nodes b of the cell, in the same way.
  template <class Visit>
  void all(int a, const Visit& visit) const {
    walk(graph_.starts[nodes_[a]], -1, visit);
  }

 private:
  template <class Visit>
  void walk(std::int64_t place, int least, const Visit& visit) const {
    for (int k = 0; k < N; ++k) {
      const int b = order_[k];
      if (nodes_[b] < least) continue;
      while (graph_.neighbours[place] != nodes_[b]) ++place;
      visit(b, place);
    }
  }

  const NodeGraph& graph_;
  int nodes_[N], order_[N];  // nodes of the cell, and their local numbers in ascending order of the nodes
};

/// Returns the graph of a mesh's solid cells.
NodeGraph node_graph(const Mesh& mesh, int threads = 1);

/// Cells sorted into colours so that no two cells of a colour share a node: cells of one colour are assembled at the
/// same time, and sums do not depend on the number of threads. @param nodes  (nodes of a cell, cells)
std::vector<std::vector<int>> colour_cells(const Eigen::MatrixXi& nodes, Eigen::Index points);

/// A symmetric matrix with one number per pair of neighbours (both triangles); stands for `m (x) I3` on vectors of
/// three components per node.
struct NodeMatrix {
  const NodeGraph* graph = nullptr;
  std::vector<double> values;  ///< in the order of `graph->neighbours`

  /// (m (x) I_k) x: node a owns k consecutive rows of x. @param x  (k points, any)
  RowMatrix multiply(const RowMatrix& x, int rows_per_node, int threads = 1) const;
  /// Computes the same product into y, which has the size of x.
  void multiply_into(const RowMatrix& x, int rows_per_node, RowMatrix& y, int threads = 1) const;
};

}  // namespace bielle::reduce
