// Dependent columns of sparse matrices: against cycles of graphs, which a count of connected parts finds exactly, and
// against dense elimination in the given order.
#include <algorithm>
#include <numeric>

#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "mechanism/math/rank.hpp"
#include "mechanism/math/types.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::Random;

namespace {

constexpr double tolerance = 1e-9;

/// A graph's edges; columns of its incidence matrix depend on earlier ones where an edge closes a cycle.
struct Graph {
  int nodes = 0;
  std::vector<std::pair<int, int>> edges;

  Eigen::SparseMatrix<double> incidence() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) {
      entries.emplace_back(edges[static_cast<std::size_t>(k)].first, k, std::sqrt(0.5));
      entries.emplace_back(edges[static_cast<std::size_t>(k)].second, k, -std::sqrt(0.5));
    }
    Eigen::SparseMatrix<double> A(nodes, static_cast<int>(edges.size()));
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }

  std::vector<int> closing() const {
    std::vector<int> above(static_cast<std::size_t>(nodes));
    std::iota(above.begin(), above.end(), 0);
    const auto root = [&](int node) {
      while (above[static_cast<std::size_t>(node)] != node)
        node = above[static_cast<std::size_t>(node)] =
            above[static_cast<std::size_t>(above[static_cast<std::size_t>(node)])];
      return node;
    };
    std::vector<int> result;
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) {
      const auto [a, b] = edges[static_cast<std::size_t>(k)];
      if (root(a) == root(b))
        result.push_back(k);
      else
        above[static_cast<std::size_t>(root(a))] = root(b);
    }
    return result;
  }
};

/// Returns two rails of n edges, joined by n + 1 rungs.
Graph ladder(int n) {
  Graph graph;
  graph.nodes = 2 * n + 2;
  for (const int rail : {0, 1})
    for (int k = 0; k < n; ++k) graph.edges.emplace_back(2 * k + rail, 2 * k + 2 + rail);
  for (int k = 0; k <= n; ++k) graph.edges.emplace_back(2 * k, 2 * k + 1);
  return graph;
}

void shuffle(Graph& graph, Random& random) {
  for (std::size_t k = graph.edges.size(); k > 1; --k) {
    const auto other = static_cast<std::size_t>(random.uniform(0, static_cast<double>(k)));
    std::swap(graph.edges[k - 1], graph.edges[std::min(other, k - 1)]);
  }
}

/// Finds dependent columns by elimination of dense columns one after another.
std::vector<int> dense_dependent(const MatrixX& A) {
  MatrixX basis(A.rows(), 0);
  std::vector<int> result;
  for (int k = 0; k < A.cols(); ++k) {
    VectorX left = A.col(k);
    for (int again = 0; again < 2; ++again) left -= basis * (basis.transpose() * left);
    if (left.norm() < tolerance) {
      result.push_back(k);
      continue;
    }
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols<1>() = left.normalized();
  }
  return result;
}

}  // namespace

TEST_CASE("edges that close a cycle depend on those before them, in any order of the edges") {
  Random random(7);
  Graph graph = ladder(40);
  for (int k = 0; k < 10; ++k) {
    CHECK(dependent_columns(graph.incidence(), tolerance) == graph.closing());
    shuffle(graph, random);
  }
}

TEST_CASE("many cycles are found at once where elimination in the given order would fill the triangle") {
  const Graph graph = ladder(20000);
  CHECK(dependent_columns(graph.incidence(), tolerance) == graph.closing());
}

TEST_CASE("a cycle of all edges makes the last of them dependent") {
  Graph graph;
  graph.nodes = 3000;
  for (int k = 0; k < graph.nodes; ++k) graph.edges.emplace_back(k, (7 * k + 1) % graph.nodes);
  CHECK(dependent_columns(graph.incidence(), tolerance) == graph.closing());
}

TEST_CASE("columns of any coefficients depend as dense elimination in the given order finds it") {
  Random random(3);
  for (int sample = 0; sample < 40; ++sample) {
    // Products of random factors have full rank but that of the inner dimension; some columns vanish, some repeat.
    MatrixX A = random.matrix(9, 5) * random.matrix(5, 8);
    A.col(2).setZero();
    A.col(6) = -2 * A.col(0);
    for (int k = 0; k < A.cols(); ++k)
      if (A.col(k).norm() > 0) A.col(k).normalize();
    CAPTURE(sample);
    CHECK(dependent_columns(A.sparseView(), tolerance) == dense_dependent(A));
  }
}

TEST_CASE("independent columns, and none at all, depend on nothing") {
  CHECK(dependent_columns(Eigen::SparseMatrix<double>(4, 0), tolerance).empty());
  const MatrixX unit = MatrixX::Identity(5, 3);
  CHECK(dependent_columns(unit.sparseView(), tolerance).empty());
  CHECK(dependent_columns(Eigen::SparseMatrix<double>(4, 2), tolerance) == std::vector<int>{0, 1});
}
