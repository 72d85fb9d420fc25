#include "reduce/fe/stress.hpp"

#include <Eigen/LU>

#include "reduce/common/sort_unique.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/fe/cell_fields.hpp"
#include "reduce/fe/internal_modes.hpp"
#include "reduce/fe/solid_block.hpp"
#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/jacobian.hpp"

namespace bielle::reduce {

namespace {

/// Returns the matrix of values at the nodes of a cell from those at the points of a rule, (nodes, points): those of
/// the functions of order 1 that fit them best.
template <int N>
Eigen::MatrixXd extrapolation(const Quadrature& rule) {
  if (rule.weights.size() == 1) return Eigen::MatrixXd::Ones(N, 1);
  using Cell = SolidCell<N>;
  Eigen::MatrixXd at_points(Cell::vertices, rule.weights.size()), at_nodes(Cell::vertices, N);
  for (Eigen::Index p = 0; p < rule.weights.size(); ++p)
    at_points.col(p) = shape_values(straight_type(Cell::type), rule.points.col(p));
  const Eigen::MatrixXd nodes = local_nodes(Cell::type);
  for (int a = 0; a < N; ++a) at_nodes.col(a) = shape_values(straight_type(Cell::type), nodes.col(a));
  const Eigen::MatrixXd to_vertices = (at_points * at_points.transpose()).inverse() * at_points;
  return at_nodes.transpose() * to_vertices;
}

template <int N>
double cell_volume(const CellRule<N>& rule, const CellPoints<N>& x) {
  double volume = 0;
  for (std::size_t p = 0; p < rule.size(); ++p) {
    volume += rule.weights(p) * jacobian_at<N>(rule, p, x).determinant();
  }
  return volume;
}

/// The material with the most volume around each node, and that volume.
struct NodeShares {
  std::vector<int> material;
  std::vector<double> volume;
};

NodeShares node_shares(const Solid& solid, const std::vector<double>& volumes) {
  const auto materials = static_cast<Eigen::Index>(solid.materials.size());
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(materials, solid.points());
  for (int e = 0; e < solid.cells.size(); ++e) {
    for (const int a : solid.cells.nodes(e)) {
      share(solid.material_of[e], a) += volumes[e];
    }
  }
  NodeShares result{std::vector<int>(solid.points()), std::vector<double>(solid.points())};
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    result.volume[a] = share.col(a).maxCoeff(&result.material[a]);
  }
  return result;
}

/// Returns the sampling points for stress in a cell.
template <int N>
Quadrature sampling() {
  return cell_quadrature(SolidCell<N>::type, N == 4 ? 0 : 2);
}

/// Returns the volumes of all cells by the sampling points.
std::vector<double> cell_volumes(const Solid& solid, int threads) {
  std::vector<double> volumes(solid.cells.size());
  for_each_block(solid, [&]<int N>(const SolidBlock& block) {
    const CellRule<N> rule(sampling<N>());
#pragma omp parallel for num_threads(threads) schedule(static)
    for (Eigen::Index e = 0; e < block.cells(); ++e) {
      volumes[block.first + e] = cell_volume<N>(rule, block.points<N>(e));
    }
  });
  return volumes;
}

/// The requested nodes with the numbers that the sum over their cells needs.
struct StressSum {
  const RowMatrix& fields;
  std::vector<double> volumes;  // volume of each cell
  NodeShares shares;
  std::vector<int> row_of;  // row of the result for each point; -1: not requested

  bool wants(const SolidBlock& block, Eigen::Index cell, int a) const {
    const int node = block.nodes(a, cell);
    return row_of[node] >= 0 && shares.material[node] == block.material_number(cell);
  }
  /// Returns the cells of the block that contribute to requested nodes.
  std::vector<int> cells(const SolidBlock& block) const {
    std::vector<int> result;
    for (int e = 0; e < block.cells(); ++e)
      for (int a = 0; a < block.nodes.rows(); ++a)
        if (wants(block, e, a)) {
          result.push_back(e);
          break;
        }
    return result;
  }
};

/// Adds the cells of a block to the stress at the requested nodes, (6 nodes, fields).
template <int N>
void add_stress(const SolidBlock& block, const StressSum& sum, int threads, RowMatrix& result) {
  const Quadrature quadrature = sampling<N>();
  const CellRule<N> rule(quadrature);
  const Eigen::MatrixXd to_nodes = extrapolation<N>(quadrature);
  const std::vector<int> cells = sum.cells(block);
  const Eigen::Index k = sum.fields.cols();
  const auto points = static_cast<Eigen::Index>(rule.size());
  const BlasThreads one(1);
  const std::vector<std::vector<int>> colours = colour_cells(block.nodes(Eigen::all, cells), block.solid.points());
#pragma omp parallel num_threads(threads)
  {
    CellFields<N> cell(points, k);
    InternalModes<N> modes(block.solid.integration);
    Eigen::MatrixXd at_points(6 * k, points);
    for (const std::vector<int>& colour : colours) {
#pragma omp for schedule(static)
      for (std::size_t c = 0; c < colour.size(); ++c) {
        const int e = cells[static_cast<std::size_t>(colour[c])];
        const CellPoints<N> x = block.points<N>(e);
        const Eigen::Matrix<double, 6, 6> elasticity = block.elasticity(e);
        set_strains(
            cell, modes, rule, x, elasticity, [&](double) { return elasticity; },
            [](Eigen::Index, const auto&, double) {});
        cell.take(sum.fields, block.nodes, e);
        cell.evaluate(points, at_points.data());
        for (int a = 0; a < N; ++a) {
          if (!sum.wants(block, e, a)) continue;
          const int node = block.nodes(a, e);
          const double share = sum.volumes[block.first + e] / sum.shares.volume[node];
          Eigen::Map<Eigen::VectorXd>(&result(6 * static_cast<Eigen::Index>(sum.row_of[node]), 0), 6 * k).noalias() +=
              at_points * (share * to_nodes.row(a)).transpose();
        }
      }
    }
  }
}

}  // namespace

RowMatrix nodal_stress(const Solid& solid, const RowMatrix& fields, const std::vector<int>& nodes, int threads) {
  StressSum sum{fields, cell_volumes(solid, threads), {}, std::vector<int>(solid.points(), -1)};
  sum.shares = node_shares(solid, sum.volumes);
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    sum.row_of[nodes[r]] = static_cast<int>(r);
  }
  RowMatrix result(6 * static_cast<Eigen::Index>(nodes.size()), fields.cols());
  if (result.size() == 0) return result;
    // The memory is written, since pages that are read before they are written are allocated twice.
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index row = 0; row < result.rows(); ++row) result.row(row).setZero();
  for_each_block(solid, [&]<int N>(const SolidBlock& block) { add_stress<N>(block, sum, threads, result); });
  return result;
}

std::vector<int> nodal_materials(const Solid& solid, const std::vector<int>& nodes) {
  const NodeShares shares = node_shares(solid, cell_volumes(solid, 1));
  std::vector<int> result;
  for (const int node : nodes) {
    result.push_back(shares.material[node]);
  }
  return result;
}

std::vector<int> surface_nodes(const Solid& solid) {
  const FaceTable faces(solid.mesh);
  std::vector<int> result;
  for (const int face : faces.boundary()) {
    const Eigen::VectorXi nodes = faces.nodes(face);
    result.insert(result.end(), nodes.begin(), nodes.end());
  }
  sort_unique(result);
  return result;
}

}  // namespace bielle::reduce
