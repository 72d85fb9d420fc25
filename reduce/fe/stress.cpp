#include "reduce/fe/stress.hpp"

#include <algorithm>
#include <array>

#include <Eigen/LU>

#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/fe/node_graph.hpp"
#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

namespace {

using Stress = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

/// Values at the nodes of a cell from those at the four points: (nodes, 4).
Eigen::MatrixXd extrapolation(CellType type, const Quadrature& rule) {
  const int vertices = vertex_count(type), nodes = node_count(type);
  if (type == CellType::tet4) {
    return Eigen::MatrixXd::Ones(nodes, 1);
  }
  Eigen::Matrix4d barycentric;
  barycentric << 1 - rule.points.colwise().sum().array(), rule.points;
  Eigen::MatrixXd result(nodes, 4);
  result.topRows(vertices) = barycentric.transpose().inverse();
  const Eigen::Matrix2Xi edges = edges_of(type);
  for (Eigen::Index e = 0; e < edges.cols(); ++e) {
    result.row(vertices + e) = (result.row(edges(0, e)) + result.row(edges(1, e))) / 2;
  }
  return result;
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
std::vector<double> cell_volumes(const Solid& solid, const CellRule<N>& rule) {
  std::vector<double> volumes(solid.cells());
  for (Eigen::Index e = 0; e < solid.cells(); ++e) {
    volumes[e] = cell_volume<N>(rule, cell_points<N>(solid.mesh.points, solid.nodes, e));
  }
  return volumes;
}

/// The points of a cell at which stress is sampled.
template <int N>
Quadrature sampling() {
  return simplex_quadrature(3, N == 4 ? 0 : 2);
}

template <int N>
NodeShares node_shares(const Solid& solid) {
  return node_shares(solid, cell_volumes<N>(solid, CellRule<N>(sampling<N>())));
}

template <int N>
RowMatrix stress_at(const Solid& solid, const RowMatrix& fields, const std::vector<int>& nodes, int threads) {
  const Quadrature quadrature = sampling<N>();
  const CellRule<N> rule(quadrature);
  const Eigen::MatrixXd to_nodes = extrapolation(CellRule<N>::type, quadrature);
  const std::vector<double> volumes = cell_volumes<N>(solid, rule);
  const NodeShares shares = node_shares(solid, volumes);
  std::vector<int> row_of(solid.points(), -1);
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    row_of[nodes[r]] = static_cast<int>(r);
  }
  const Eigen::Index k = fields.cols();
  RowMatrix result = RowMatrix::Zero(6 * static_cast<Eigen::Index>(nodes.size()), k);
  for (const std::vector<int>& cells : colour_cells(solid.nodes, solid.points())) {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const int e = cells[c];
      const int material = solid.material_of[e];
      const auto wanted = [&](int a) { return row_of[a] >= 0 && shares.material[a] == material; };
      const auto cell_nodes = solid.nodes.col(e);
      if (std::none_of(cell_nodes.begin(), cell_nodes.end(), wanted)) {
        continue;
      }
      const CellPoints<N> x = cell_points<N>(solid.mesh.points, solid.nodes, e);
      std::array<Stress, 4> at_points;
      Eigen::Matrix<double, N, 3> gradients;
      for (std::size_t p = 0; p < rule.size(); ++p) {
        map_point<N>(rule, p, x, gradients);
        Stress strain = Stress::Zero(6, k);
        for (int a = 0; a < N; ++a) {
          for (int i = 0; i < 3; ++i) {
            const auto u = fields.row(3 * cell_nodes(a) + i);
            for (int j = 0; j < 3; ++j) {
              strain.row(voigt(i, j)) += gradients(a, j) * u;
            }
          }
        }
        at_points[p] = solid.materials[material].elasticity * strain;
      }
      for (int a = 0; a < N; ++a) {
        if (!wanted(cell_nodes(a))) {
          continue;
        }
        const double weight = volumes[e] / shares.volume[cell_nodes(a)];
        for (std::size_t p = 0; p < rule.size(); ++p) {
          result.middleRows<6>(6 * row_of[cell_nodes(a)]) += weight * to_nodes(a, p) * at_points[p];
        }
      }
    }
  }
  return result;
}

}  // namespace

RowMatrix nodal_stress(const Solid& solid, const RowMatrix& fields, const std::vector<int>& nodes, int threads) {
  return solid.type == CellType::tet4 ? stress_at<4>(solid, fields, nodes, threads)
                                      : stress_at<10>(solid, fields, nodes, threads);
}

std::vector<int> nodal_materials(const Solid& solid, const std::vector<int>& nodes) {
  const NodeShares shares = solid.type == CellType::tet4 ? node_shares<4>(solid) : node_shares<10>(solid);
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
