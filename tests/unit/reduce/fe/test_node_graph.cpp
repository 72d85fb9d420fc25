#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "reduce/fe/node_graph.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE("Two nodes are neighbours in the graph if they share a cell") {
  Eigen::MatrixXi cells(4, 2);
  cells << 0, 1, 1, 2, 2, 3, 3, 5;
  const NodeGraph graph = node_graph(Mesh{Eigen::Matrix3Xd::Zero(3, 7), {{CellType::tet4, cells}}, {}}, 2);
  const auto of = [&](int a) {
    return std::vector<int>(graph.neighbours.begin() + graph.starts[a], graph.neighbours.begin() + graph.starts[a + 1]);
  };
  CHECK(of(0) == std::vector<int>{0, 1, 2, 3});
  CHECK(of(1) == std::vector<int>{0, 1, 2, 3, 5});
  CHECK(of(4).empty());
  CHECK(of(5) == std::vector<int>{1, 2, 3, 5});
  CHECK(graph.neighbours[graph.place(5, 2)] == 2);
}

TEST_CASE("Cells of one colour share no node, and every cell has a colour") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {4, 3, 5}});
  const Eigen::MatrixXi& cells = mesh.blocks[0].nodes;
  std::set<int> coloured;
  for (const auto& colour : colour_cells(cells, mesh.point_count())) {
    std::set<int> nodes;
    for (const int e : colour) {
      coloured.insert(e);
      for (const int a : cells.col(e)) {
        CHECK(nodes.insert(a).second);
      }
    }
  }
  CHECK(static_cast<Eigen::Index>(coloured.size()) == cells.cols());
}

TEST_CASE("The places of all pairs of a cell equal the places of single pairs") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 3, 2}});
  const Eigen::MatrixXi& cells = mesh.blocks[0].nodes;
  const NodeGraph graph = node_graph(mesh);
  for (Eigen::Index e = 0; e < cells.cols(); ++e) {
    const CellPlaces<10> places(graph, cells, e);
    for (int a = 0; a < 10; ++a) {
      const int low = cells(a, e);
      int all = 0, higher = 0, expected = 0;
      for (int b = 0; b < 10; ++b) expected += cells(b, e) >= low;
      places.all(a, [&](int b, std::int64_t place) { all += place == graph.place(low, cells(b, e)); });
      places.from(a, graph.place(low, low), [&](int b, std::int64_t place) {
        higher += cells(b, e) >= low && place == graph.place(low, cells(b, e));
      });
      CHECK(all == 10);
      CHECK(higher == expected);
    }
  }
}

TEST_CASE("A node matrix acts on each component of the nodes in the same way") {
  Eigen::MatrixXi cells(4, 1);
  cells << 0, 1, 2, 3;
  const NodeGraph graph = node_graph(Mesh{Eigen::Matrix3Xd::Zero(3, 4), {{CellType::tet4, cells}}, {}});
  NodeMatrix m{&graph, std::vector<double>(16)};
  Eigen::Matrix4d dense;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      dense(a, b) = m.values[graph.place(a, b)] = 1 + a * b + a + b;
    }
  }
  for (const int columns : {1, 2, 3, 4, 7, 16, 19}) {  // covers every width of strips
    const RowMatrix x = RowMatrix::Random(12, columns);
    const RowMatrix y = m.multiply(x, 3, 2);
    for (int i = 0; i < 3; ++i) {
      const auto component = Eigen::seqN(i, 4, 3);
      CHECK((y(component, Eigen::all) - dense * x(component, Eigen::all)).norm() < 1e-12);
    }
  }
}
