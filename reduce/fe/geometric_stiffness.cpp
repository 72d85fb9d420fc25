#include "reduce/fe/geometric_stiffness.hpp"

#include <algorithm>
#include <memory>

#include <omp.h>

#include "reduce/dense/blas.hpp"
#include "reduce/fe/cell_fields.hpp"
#include "reduce/fe/internal_modes.hpp"
#include "reduce/fe/solid_block.hpp"

namespace bielle::reduce {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The matrices g of all fields, lower triangles with half of the diagonal: column `first[a] + j` has the numbers of
/// all fields for node a and its j-th neighbour from itself on.
struct FieldMatrices {
  Index fields;
  std::vector<std::int64_t> first{0};  ///< first column of each node, and the end
  std::vector<std::int64_t> own;       ///< place of node a among its own neighbours
  std::unique_ptr<double[]> values;    ///< (fields, pairs)

  FieldMatrices(const NodeGraph& graph, Index count, int threads) : fields(count) {
    for (int a = 0; a < graph.size(); ++a) {
      own.push_back(graph.starts[a] == graph.starts[a + 1] ? graph.starts[a] : graph.place(a, a));
      first.push_back(first.back() + graph.starts[a + 1] - own[a]);
    }
    values = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(fields * first.back()));
#pragma omp parallel for num_threads(threads) schedule(static)
    for (Index a = 0; a < graph.size(); ++a) std::fill(column(first[a]), column(first[a + 1]), 0.0);
  }
  double* column(std::int64_t pair) { return values.get() + pair * fields; }
  const double* column(std::int64_t pair) const { return values.get() + pair * fields; }
};

/// Returns a rule that is exact to degree 3 (P. Keast, Comput. Methods Appl. Mech. Eng. 55 (1986) 339), for the product
/// of a linear stress and two linear gradients.
Quadrature five_points() {
  Quadrature rule{Eigen::MatrixXd::Constant(3, 5, 1.0 / 6), Eigen::VectorXd::Constant(5, 3.0 / 40)};
  rule.points.leftCols<3>().diagonal().setConstant(0.5);
  rule.points.col(4).setConstant(0.25);
  rule.weights(4) = -2.0 / 15;
  return rule;
}

/// Sets the factors of the stress components xx yy zz yz xz xy of one field in g_ab: products of gradients, and sums of
/// two products for the shear components. Rows 6 p + s of a column for each pair a <= b of nodes; the diagonal of g is
/// halved.
template <int N>
void set_products(const Eigen::Matrix<double, N, 3>& d, Index p, MatrixXd& products) {
  double* column = &products(6 * p, 0);
  for (int a = 0; a < N; ++a) {
    for (int b = a; b < N; ++b, column += products.rows()) {
      const double half = a == b ? 0.5 : 1, x = half * d(b, 0), y = half * d(b, 1), z = half * d(b, 2);
      column[0] = d(a, 0) * x;
      column[1] = d(a, 1) * y;
      column[2] = d(a, 2) * z;
      column[3] = d(a, 1) * z + d(a, 2) * y;
      column[4] = d(a, 0) * z + d(a, 2) * x;
      column[5] = d(a, 0) * y + d(a, 1) * x;
    }
  }
}

/// Returns the number of a pair of nodes of a cell, in the order of `set_products`.
constexpr int pair_number(int a, int b, int nodes) {
  return a <= b ? a * nodes - a * (a - 1) / 2 + b - a : pair_number(b, a, nodes);
}

template <int N>
void add_cells(const SolidBlock& block, const NodeGraph& graph, const RowMatrix& fields, FieldMatrices& g,
               int threads) {
  constexpr int pairs = N * (N + 1) / 2;
  const CellDegrees degrees = stiffness_degrees<N>(block.solid.integration);
  const CellRule<N> straight(N == 10 ? five_points() : cell_quadrature(SolidCell<N>::type, degrees.straight));
  const CellRule<N> curved(cell_quadrature(SolidCell<N>::type, degrees.curved));
  const Index count = fields.cols(), most = static_cast<Index>(std::max(straight.size(), curved.size()));
  const std::vector<std::vector<int>> colours = colour_cells(block.nodes, block.solid.points());
#pragma omp parallel num_threads(threads)
  {
    CellFields<N> cell(most, count);
    InternalModes<N> modes(block.solid.integration);
    MatrixXd stresses(count, 6 * most), products(6 * most, pairs), sums(count, pairs);
    for (const std::vector<int>& colour : colours) {
#pragma omp for schedule(static)
      for (std::size_t k = 0; k < colour.size(); ++k) {
        const int e = colour[k];
        const CellPoints<N> x = block.points<N>(e);
        const CellRule<N>& rule = is_straight(SolidCell<N>::type, x) ? straight : curved;
        const auto points = static_cast<Index>(rule.size());
        const Eigen::Matrix<double, 6, 6> elasticity = block.elasticity(e);
        set_strains(
            cell, modes, rule, x, elasticity, [&](double volume) { return Matrix6(volume * elasticity); },
            [&](Index p, const auto& gradients, double) { set_products<N>(gradients, p, products); });
        cell.take(fields, block.nodes, e);
        cell.evaluate(points, stresses.data());
        sums.setZero();
        add_dense_product({stresses.data(), count, 6 * points, count, false},
                          {products.data(), 6 * points, pairs, products.rows(), false}, sums.data(), count);
        const CellPlaces<N> places(graph, block.nodes, e);
        for (int a = 0; a < N; ++a) {
          const int low = block.nodes(a, e);
          places.from(a, g.own[low], [&](int b, std::int64_t place) {
            Eigen::Map<Eigen::VectorXd>(g.column(g.first[low] + place - g.own[low]), count) +=
                sums.col(pair_number(a, b, N));
          });
        }
      }
    }
  }
}

/// Gathers the numbers g_ab of all fields for node a and all its neighbours b: (fields, neighbours); the block of a
/// itself is complete.
void gather(const NodeGraph& graph, const FieldMatrices& g, int a, double* row) {
  for (std::int64_t place = graph.starts[a]; place < graph.starts[a + 1]; ++place, row += g.fields) {
    const int b = graph.neighbours[place];
    const std::int64_t pair = b < a ? g.first[b] + graph.place(b, a) - g.own[b] : g.first[a] + place - g.own[a];
    const double scale = b == a ? 2 : 1;  // half of the diagonal is kept
    for (Index f = 0; f < g.fields; ++f) row[f] = scale * g.column(pair)[f];
  }
}

/// One thread's sum over nodes a, neighbours b and components i of T_ai^T g_ab T_bi, lower triangles.
class ReducedSum {
 public:
  ReducedSum(const NodeGraph& graph, const FieldMatrices& g, const RowMatrix& shapes)
      : graph_(graph),
        g_(g),
        shapes_(shapes),
        fields_(g.fields),
        n_(shapes.cols()),
        width_(3 * n_),
        made_(at_a_time * width_ * fields_),
        sum_(MatrixXd::Zero(n_, n_ * fields_)) {}

  static constexpr Index at_a_time = 32;  // number of nodes whose products stay in the cache

  void add_nodes(Index begin, Index end) {
    for (Index a = begin; a < end; ++a) make(static_cast<int>(a), made_.data() + (a - begin) * width_ * fields_);
    // Rows of T and of the product g T are x, y and z of each node. Symmetric matrices need no block above the
    // diagonal.
    const Index rows = 3 * (end - begin);
    for (Index j = 0; j < n_; j += block) {
      const Index columns = fields_ * std::min(block, n_ - j);
      add_dense_product({&shapes_.coeffRef(3 * begin, j), n_ - j, rows, n_, false},
                        {made_.data() + j * fields_, rows, columns, n_ * fields_, true}, &sum_(j, j * fields_), n_);
    }
  }
  /// (n, n fields), columns of field f at f, f + fields, ...; entries above the diagonals are not valid.
  const MatrixXd& sum() const { return sum_; }

 private:
  static constexpr Index block = 16;  // number of shapes; all fields of a shape are next to each other

  /// Rows x, y, z of node a in g T: (fields, 3 n).
  void make(int a, double* out) {
    const Index count = graph_.starts[a + 1] - graph_.starts[a];
    around_.resize(std::max<std::size_t>(around_.size(), count * width_));
    weights_.resize(std::max<std::size_t>(weights_.size(), count * fields_));
    gather(graph_, g_, a, weights_.data());
    for (Index j = 0; j < count; ++j) {
      const Index b = graph_.neighbours[graph_.starts[a] + j];
      std::copy_n(&shapes_.coeffRef(3 * b, 0), width_, around_.data() + j * width_);
    }
    std::fill_n(out, width_ * fields_, 0.0);
    add_dense_product({weights_.data(), fields_, count, fields_, false}, {around_.data(), count, width_, width_, true},
                      out, fields_);
  }

  const NodeGraph& graph_;
  const FieldMatrices& g_;
  const RowMatrix& shapes_;
  Index fields_, n_, width_;
  std::vector<double> around_, weights_;  // rows of T of a node's neighbours; numbers g_ab
  std::vector<double> made_;              // rows of each node: (fields, 3 n)
  MatrixXd sum_;
};

/// Returns T^T (g (x) I3) T of all fields: (n, n fields), in the layout of ReducedSum.
MatrixXd reduce(const NodeGraph& graph, const FieldMatrices& g, const RowMatrix& shapes, int threads) {
  std::vector<MatrixXd> sums(static_cast<std::size_t>(threads));
#pragma omp parallel num_threads(threads)
  {
    ReducedSum own(graph, g, shapes);
#pragma omp for schedule(static)
    for (Index begin = 0; begin < graph.size(); begin += ReducedSum::at_a_time)
      own.add_nodes(begin, std::min(graph.size(), begin + ReducedSum::at_a_time));
    sums[static_cast<std::size_t>(omp_get_thread_num())] = own.sum();
  }
  for (std::size_t k = 1; k < sums.size(); ++k)
    if (sums[k].size() > 0) sums[0] += sums[k];
  return sums[0];
}

}  // namespace

std::vector<MatrixXd> reduced_geometric_stiffness(const Solid& solid, const NodeGraph& graph, const RowMatrix& fields,
                                                  const RowMatrix& shapes, int threads) {
  const Index count = fields.cols(), n = shapes.cols();
  const BlasThreads one(1);
  FieldMatrices g(graph, count, threads);
  for_each_block(solid, [&]<int N>(const SolidBlock& block) { add_cells<N>(block, graph, fields, g, threads); });
  const MatrixXd sums = reduce(graph, g, shapes, threads);
  std::vector<MatrixXd> result;
  for (Index f = 0; f < count; ++f) {
    const MatrixXd lower = sums(Eigen::all, Eigen::seqN(f, n, count));
    result.push_back(lower.selfadjointView<Eigen::Lower>());
  }
  return result;
}

}  // namespace bielle::reduce
