#include "reduce/fe/geometric_stiffness.hpp"

#include <algorithm>

#include <omp.h>

#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/spectral/blas.hpp"

namespace bielle::reduce {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The matrices g of all fields, lower triangles with half of the diagonal: column `first[a] + j` has the numbers of
/// all fields for node a and its j-th neighbour from itself on.
struct FieldMatrices {
  std::vector<std::int64_t> first;  ///< and one more
  std::vector<std::int64_t> own;    ///< place of node a among its own neighbours
  MatrixXd values;                  ///< (fields, pairs)

  FieldMatrices(const NodeGraph& graph, Index fields) : first{0} {
    for (int a = 0; a < graph.size(); ++a) {
      own.push_back(graph.starts[a] == graph.starts[a + 1] ? graph.starts[a] : graph.place(a, a));
      first.push_back(first.back() + graph.starts[a + 1] - own[a]);
    }
    values = MatrixXd::Zero(fields, first.back());
  }
};

/// Places of the components of a symmetric tensor, and the products of gradients that they multiply.
constexpr int tensor_rows[6] = {0, 1, 2, 1, 0, 0}, tensor_columns[6] = {0, 1, 2, 2, 2, 1};

template <int N>
void add_cells(const Solid& solid, const NodeGraph& graph, const RowMatrix& fields, FieldMatrices& g, int threads) {
  constexpr int pairs = N * (N + 1) / 2;
  const CellRules<N> rules(N == 4 ? CellDegrees{0, 0} : CellDegrees{3, 5});
  const Index count = fields.cols();
  for_each_cell(solid.nodes, solid.points(), threads, [&](Index e) {
    const CellPoints<N> x = cell_points<N>(solid.mesh.points, solid.nodes, e);
    const CellRule<N>& rule = rules.of(x);
    const auto& elasticity = solid.materials[solid.material_of[e]].elasticity;
    const auto points = static_cast<Index>(rule.size());
    // Row 3 f + i: displacements along i of field f; columns 3 p + j: gradients along j at point p.
    MatrixXd displacements(3 * count, N), gradients(N, 3 * points), products(6 * points, pairs);
    for (int a = 0; a < N; ++a) {
      for (Index f = 0; f < count; ++f) {
        displacements.block<3, 1>(3 * f, a) = fields.block<3, 1>(3 * solid.nodes(a, e), f);
      }
    }
    Eigen::VectorXd volumes(points);
    Eigen::Matrix<double, N, 3> d;
    for (Index p = 0; p < points; ++p) {
      volumes(p) = map_point<N>(rule, static_cast<std::size_t>(p), x, d);
      gradients.middleCols<3>(3 * p) = d;
      int pair = 0;
      for (int a = 0; a < N; ++a) {
        for (int b = a; b < N; ++b, ++pair) {
          for (int s = 0; s < 6; ++s) {
            const int i = tensor_rows[s], j = tensor_columns[s];
            // Components off the diagonal stand for two; the diagonal of g is halved.
            products(6 * p + s, pair) =
                (i == j ? 1 : 2) * (a == b ? 0.5 : 1) * (d(a, i) * d(b, j) + d(a, j) * d(b, i)) / 2;
          }
        }
      }
    }
    const MatrixXd h = dense_product(displacements, gradients);
    MatrixXd stresses(count, 6 * points);
    for (Index f = 0; f < count; ++f) {
      for (Index p = 0; p < points; ++p) {
        stresses.block<1, 6>(f, 6 * p) = volumes(p) * (elasticity * strain_of(h.block<3, 3>(3 * f, 3 * p))).transpose();
      }
    }
    const MatrixXd sums = dense_product(stresses, products);
    int pair = 0;
    for (int a = 0; a < N; ++a) {
      for (int b = a; b < N; ++b, ++pair) {
        const auto [low, high] = std::minmax(solid.nodes(a, e), solid.nodes(b, e));
        g.values.col(g.first[low] + graph.place(low, high) - g.own[low]) += sums.col(pair);
      }
    }
  });
}

/// The sum over nodes a, neighbours b and components i of T_ai^T g_ab T_bi: (n, n fields), columns of field f at f, f +
/// fields, ...
MatrixXd reduce(const NodeGraph& graph, const FieldMatrices& g, const RowMatrix& shapes, int threads) {
  const Index n = shapes.cols(), fields = g.values.rows(), nodes = graph.size(), width = 3 * n;
  constexpr Index batch = 32;  // nodes: what they make stays in the cache
  std::vector<MatrixXd> sums(threads, MatrixXd::Zero(n, n * fields));
#pragma omp parallel num_threads(threads)
  {
    MatrixXd& sum = sums[omp_get_thread_num()];
    std::vector<double> around;                        // rows of T of a node's neighbours
    std::vector<double> made(batch * width * fields);  // of each node: (fields, 3 n)
#pragma omp for schedule(static)
    for (Index begin = 0; begin < nodes; begin += batch) {
      const Index end = std::min(nodes, begin + batch);
      for (Index a = begin; a < end; ++a) {
        const Index count = g.first[a + 1] - g.first[a];
        around.resize(std::max<std::size_t>(around.size(), count * width));
        for (Index j = 0; j < count; ++j) {
          std::copy_n(&shapes.coeffRef(3 * graph.neighbours[g.own[a] + j], 0), width, around.data() + j * width);
        }
        double* const out = made.data() + (a - begin) * width * fields;
        std::fill_n(out, width * fields, 0.0);
        add_dense_product({g.values.data() + g.first[a] * fields, fields, count, fields, false},
                          {around.data(), count, width, width, true}, out, fields);
      }
      for (int i = 0; i < 3; ++i) {
        add_dense_product({&shapes.coeffRef(3 * begin, 0) + i * n, n, end - begin, width, false},
                          {made.data() + i * n * fields, end - begin, n * fields, width * fields, true}, sum.data(), n);
      }
    }
  }
  for (std::size_t k = 1; k < sums.size(); ++k) {
    sums[0] += sums[k];
  }
  return sums[0];
}

}  // namespace

std::vector<MatrixXd> reduced_geometric_stiffness(const Solid& solid, const NodeGraph& graph, const RowMatrix& fields,
                                                  const RowMatrix& shapes, int threads) {
  const Index count = fields.cols(), n = shapes.cols();
  const BlasThreads one(1);
  FieldMatrices g(graph, count);
  solid.type == CellType::tet4 ? add_cells<4>(solid, graph, fields, g, threads)
                               : add_cells<10>(solid, graph, fields, g, threads);
  const MatrixXd sums = reduce(graph, g, shapes, threads);
  std::vector<MatrixXd> result;
  for (Index f = 0; f < count; ++f) {
    const MatrixXd half = sums(Eigen::all, Eigen::seqN(f, n, count));
    result.push_back(half + half.transpose());
  }
  return result;
}

}  // namespace bielle::reduce
