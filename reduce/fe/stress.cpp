#include "reduce/fe/stress.hpp"

#include <algorithm>

#include <Eigen/LU>

#include "reduce/dense/blas.hpp"
#include "reduce/fe/cell_fields.hpp"
#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/internal_modes.hpp"
#include "reduce/fe/node_graph.hpp"
#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

namespace {

/// Values at the nodes of a cell from those at the points of a rule, (nodes, points): those of the functions of order 1
/// that fit them best.
template <int N>
Eigen::MatrixXd extrapolation(const Quadrature& rule) {
  if (rule.weights.size() == 1) return Eigen::MatrixXd::Ones(N, 1);
  using Cell = SolidCell<N>;
  Eigen::MatrixXd at_points(Cell::vertices, rule.weights.size()), at_nodes(Cell::vertices, N);
  for (Eigen::Index p = 0; p < rule.weights.size(); ++p)
    at_points.col(p) = shape_values(Cell::linear_type, rule.points.col(p));
  const Eigen::MatrixXd nodes = local_nodes(Cell::type);
  for (int a = 0; a < N; ++a) at_nodes.col(a) = shape_values(Cell::linear_type, nodes.col(a));
  const Eigen::MatrixXd to_vertices = (at_points * at_points.transpose()).inverse() * at_points;
  return at_nodes.transpose() * to_vertices;
}

template <int N>
double cell_volume(const CellRule<N>& rule, const CellPoints<N>& x) {
  double volume = 0;
  for (std::size_t p = 0; p < rule.size(); ++p) {
    volume += rule.weights(p) * Eigen::Matrix3d(x * rule.local_gradients[p]).determinant();
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
  for (Eigen::Index e = 0; e < solid.cells(); ++e) {
    for (const int a : solid.nodes.col(e)) {
      share(solid.material_of[e], a) += volumes[e];
    }
  }
  NodeShares result{std::vector<int>(solid.points()), std::vector<double>(solid.points())};
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    result.volume[a] = share.col(a).maxCoeff(&result.material[a]);
  }
  return result;
}

template <int N>
std::vector<double> cell_volumes(const Solid& solid, const CellRule<N>& rule, int threads) {
  std::vector<double> volumes(solid.cells());
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index e = 0; e < solid.cells(); ++e) {
    volumes[e] = cell_volume<N>(rule, cell_points<N>(solid.mesh.points, solid.nodes, e));
  }
  return volumes;
}

/// The sampling points for stress in a cell.
template <int N>
Quadrature sampling() {
  return cell_quadrature(SolidCell<N>::type, N == 4 ? 0 : 2);
}

template <int N>
NodeShares node_shares(const Solid& solid) {
  return node_shares(solid, cell_volumes<N>(solid, CellRule<N>(sampling<N>()), 1));
}

template <int N>
RowMatrix stress_at(const Solid& solid, const RowMatrix& fields, const std::vector<int>& nodes, int threads) {
  const Quadrature quadrature = sampling<N>();
  const CellRule<N> rule(quadrature);
  const Eigen::MatrixXd to_nodes = extrapolation<N>(quadrature);
  const std::vector<double> volumes = cell_volumes<N>(solid, rule, threads);
  const NodeShares shares = node_shares(solid, volumes);
  std::vector<int> row_of(solid.points(), -1);
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    row_of[nodes[r]] = static_cast<int>(r);
  }
  const auto wanted = [&](Eigen::Index e, int a) {
    return row_of[solid.nodes(a, e)] >= 0 && shares.material[solid.nodes(a, e)] == solid.material_of[e];
  };
  std::vector<int> cells;  // cells that contribute to the requested nodes
  for (Eigen::Index e = 0; e < solid.cells(); ++e)
    for (int a = 0; a < N; ++a)
      if (wanted(e, a)) {
        cells.push_back(static_cast<int>(e));
        break;
      }
  const Eigen::Index k = fields.cols();
  const auto points = static_cast<Eigen::Index>(rule.size());
  RowMatrix result(6 * static_cast<Eigen::Index>(nodes.size()), k);
  if (result.size() == 0) return result;
    // The memory is written, since pages that are read before they are written are allocated twice.
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index row = 0; row < result.rows(); ++row) result.row(row).setZero();
  const BlasThreads one(1);
  const std::vector<std::vector<int>> colours = colour_cells(solid.nodes(Eigen::all, cells), solid.points());
#pragma omp parallel num_threads(threads)
  {
    CellFields<N> cell(points, k);
    InternalModes<N> modes;
    Eigen::MatrixXd at_points(6 * k, points);
    for (const std::vector<int>& colour : colours) {
#pragma omp for schedule(static)
      for (std::size_t c = 0; c < colour.size(); ++c) {
        const int e = cells[static_cast<std::size_t>(colour[c])];
        const CellPoints<N> x = cell_points<N>(solid.mesh.points, solid.nodes, e);
        const auto& elasticity = solid.materials[solid.material_of[e]].elasticity;
        set_strains(
            cell, modes, rule, x, elasticity, [&](double) { return elasticity; },
            [](Eigen::Index, const auto&, double) {});
        cell.take(fields, solid.nodes, e);
        cell.evaluate(points, at_points.data());
        for (int a = 0; a < N; ++a) {
          if (!wanted(e, a)) continue;
          const int node = solid.nodes(a, e);
          Eigen::Map<Eigen::VectorXd>(&result(6 * static_cast<Eigen::Index>(row_of[node]), 0), 6 * k).noalias() +=
              at_points * (volumes[e] / shares.volume[node] * to_nodes.row(a)).transpose();
        }
      }
    }
  }
  return result;
}

}  // namespace

RowMatrix nodal_stress(const Solid& solid, const RowMatrix& fields, const std::vector<int>& nodes, int threads) {
  return with_nodes_of(solid.type, [&]<int N>() { return stress_at<N>(solid, fields, nodes, threads); });
}

std::vector<int> nodal_materials(const Solid& solid, const std::vector<int>& nodes) {
  const NodeShares shares = with_nodes_of(solid.type, [&]<int N>() { return node_shares<N>(solid); });
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
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace bielle::reduce
