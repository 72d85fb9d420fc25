#include "reduce/fe/assembly.hpp"

#include <array>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/fe/cell_mass.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/fe/internal_modes.hpp"
#include "reduce/fe/solid_block.hpp"

namespace bielle::reduce {

namespace {

/// Records the inverted cell with the lowest number; any thread may call it.
class InvertedCells {
 public:
  void note(int cell) {
    int lowest = lowest_.load();
    while ((lowest < 0 || cell < lowest) && !lowest_.compare_exchange_weak(lowest, cell)) {
    }
  }
  void check(const Solid& solid) const {
    if (const int cell = lowest_.load(); cell >= 0) {
      const Eigen::Vector3d centre = solid.cells.points(cell).rowwise().mean();
      throw ComputationError(
          fmt::format("cell {} of the mesh, near ({:.6g}, {:.6g}, {:.6g}) m, is turned inside out; mesh "
                      "that region finer or with straight edges",
                      cell, centre.x(), centre.y(), centre.z()));
    }
  }

 private:
  std::atomic<int> lowest_{-1};
};

/// Returns the pattern of K: columns of node b hold the rest of its own block, then the blocks of its neighbours with
/// higher numbers.
SymmetricMatrix stiffness_pattern(const NodeGraph& graph) {
  SymmetricMatrix k;
  k.size = 3 * graph.size();
  k.starts.reserve(k.size + 1);
  k.rows.reserve(9 * (graph.neighbours.size() + graph.size()) / 2);
  for (int b = 0; b < graph.size(); ++b) {
    for (int j = 0; j < 3; ++j) {
      for (int i = j; i < 3; ++i) {
        k.rows.push_back(3 * b + i);
      }
      for (std::int64_t p = graph.starts[b]; p < graph.starts[b + 1]; ++p) {
        if (const int a = graph.neighbours[p]; a > b) {
          k.rows.insert(k.rows.end(), {3 * a, 3 * a + 1, 3 * a + 2});
        }
      }
      k.starts.push_back(static_cast<std::int64_t>(k.rows.size()));
    }
  }
  k.values.assign(k.rows.size(), 0.0);
  return k;
}

/// Column of blocks b, and the position of the block's row among the neighbours after b itself.
struct BlockPlace {
  int b;
  std::int64_t behind;
};

/// @param block  K_ab(i,j) at i + 3 j
void add_block(const BlockPlace& to, const double* block, SymmetricMatrix& k) {
  for (int j = 0; j < 3; ++j) {
    double* column = &k.values[k.starts[3 * to.b + j]];
    if (to.behind == 0) {
      for (int i = j; i < 3; ++i) column[i - j] += block[i + 3 * j];
    } else {  // three rows for each higher neighbour follow the node's own block
      for (int i = 0; i < 3; ++i) column[3 * to.behind - j + i] += block[i + 3 * j];
    }
  }
}

/// Returns the part that the internal modes of a cell take from its stiffness, (3 nodes, 3 nodes).
template <int N>
Eigen::Matrix<double, 3 * N, 3 * N> condensed_stiffness(const CellPoints<N>& x,
                                                        const Eigen::Matrix<double, 6, 6>& elasticity) {
  thread_local InternalModes<N> modes(Integration::standard);
  modes.set(x, elasticity);
  return modes.condensed();
}

/// Adds the cells' stiffness, which is computed by blocks: K_ab(i,k) in row i + 3 k of column a + N b, for all a >= b
/// in the order of the mesh.
template <int N>
void add_stiffness(const SolidBlock& block, const NodeGraph& graph, SymmetricMatrix& k, int threads) {
  const CellRules<N> rules(stiffness_degrees<N>(block.solid.integration));
  std::vector<Eigen::Matrix<double, 9, 9>> tensors;
  for (const Material& material : block.solid.materials) {
    tensors.push_back(elasticity_tensor(material.elasticity));
  }
  const bool condense = InternalModes<N>::any && block.solid.integration != Integration::plain;
  InvertedCells inverted;
  constexpr int most_points = N == 4 ? 1 : SolidCell<N>::is_second_order ? 27 : 8, pairs = N * (N + 1) / 2;
  const BlasThreads one(1);
  for_each_cell(block, threads, [&](int e) {
    const CellPoints<N> x = block.points<N>(e);
    const CellRule<N>& rule = rules.of(x);
    Eigen::Matrix<double, 3 * N, most_points> g, weighted;
    Eigen::Matrix<double, N, 3> gradients;
    for (std::size_t p = 0; p < rule.size(); ++p) {
      const double volume = map_point<N>(rule, p, x, gradients);
      if (!(volume > 0)) {
        inverted.note(block.first + e);
        return;
      }
      g.col(static_cast<Eigen::Index>(p)) = gradients.transpose().reshaped();
      weighted.col(static_cast<Eigen::Index>(p)) = volume * g.col(static_cast<Eigen::Index>(p));
    }
    // w_(3a+j)(3b+l) = int dN_a/dx_j dN_b/dx_l dV
    Eigen::Matrix<double, 3 * N, 3 * N> w = Eigen::Matrix<double, 3 * N, 3 * N>::Zero();
    const auto points = static_cast<Eigen::Index>(rule.size());
    add_dense_product({weighted.data(), 3 * N, points, 3 * N, false}, {g.data(), points, 3 * N, 3 * N, true}, w.data(),
                      3 * N);
    const CellPlaces<N> places(graph, block.nodes, e);
    std::array<BlockPlace, pairs> to;
    Eigen::Matrix<double, 9, pairs> w_of_pairs, k_of_pairs = Eigen::Matrix<double, 9, pairs>::Zero();
    Eigen::Matrix<double, 3 * N, 3 * N> condensed;
    if constexpr (InternalModes<N>::any)
      if (condense) condensed = condensed_stiffness<N>(x, block.elasticity(e));
    int pair = 0;
    for (int cell_b = 0; cell_b < N; ++cell_b) {
      const int b = block.nodes(cell_b, e);
      const std::int64_t own = graph.place(b, b);
      places.from(cell_b, own, [&](int cell_a, std::int64_t place) {
        w_of_pairs.col(pair) = w.template block<3, 3>(3 * cell_a, 3 * cell_b).reshaped();
        if constexpr (InternalModes<N>::any)
          if (condense) k_of_pairs.col(pair) = condensed.template block<3, 3>(3 * cell_a, 3 * cell_b).reshaped();
        to[static_cast<std::size_t>(pair++)] = {b, place - own};
      });
    }
    Eigen::Matrix<double, 9, 9> tensor = tensors[block.material_number(e)];
    if (block.material(e).is_wound()) tensor = elasticity_tensor(block.elasticity(e));
    add_dense_product({tensor.data(), 9, 9, 9, false}, {w_of_pairs.data(), 9, pairs, 9, false}, k_of_pairs.data(), 9);
    for (pair = 0; pair < pairs; ++pair) add_block(to[static_cast<std::size_t>(pair)], k_of_pairs.col(pair).data(), k);
  });
  inverted.check(block.solid);
}

template <int N>
void add_to_node_matrix(const SolidBlock& block, const NodeGraph& graph, Eigen::Index e,
                        const Eigen::Matrix<double, N, N>& values, NodeMatrix& m) {
  const CellPlaces<N> places(graph, block.nodes, e);
  for (int a = 0; a < N; ++a) places.all(a, [&](int b, std::int64_t place) { m.values[place] += values(a, b); });
}

template <int N>
void add_mass(const SolidBlock& block, const NodeGraph& graph, NodeMatrix& m, int threads) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const CellMass<N> mass;
  InvertedCells inverted;
  for_each_cell(block, threads, [&](int e) {
    double least_jacobian = 0;
    const Matrix reference = mass.of(block.points<N>(e), least_jacobian);
    if (!(least_jacobian > 0)) inverted.note(block.first + e);
    const double density = block.material(e).density;
    const Matrix used = block.solid.lumped ? lumped_mass<Matrix>(reference, SolidCell<N>::is_second_order) : reference;
    add_to_node_matrix<N>(block, graph, e, density * used, m);
  });
  inverted.check(block.solid);
}

void add_coating(const Solid& solid, const Coating& coating, const NodeGraph& graph, NodeMatrix& m) {
  for_each_face(solid.mesh, coating.faces, [&](const FacePoints& face) {
    Eigen::MatrixXd mass = coating.mass_per_area * face_mass(face);
    if (solid.lumped) mass = lumped_mass(mass, cell_info(face.type).order == 2);
    for (Eigen::Index b = 0; b < face.nodes.size(); ++b)
      for (Eigen::Index a = 0; a < face.nodes.size(); ++a)
        m.values[static_cast<std::size_t>(graph.place(face.nodes(a), face.nodes(b)))] += mass(a, b);
  });
}

}  // namespace

SymmetricMatrix assemble_stiffness(const Solid& solid, const NodeGraph& graph, int threads) {
  SymmetricMatrix k = stiffness_pattern(graph);
  for_each_block(solid, [&]<int N>(const SolidBlock& block) { add_stiffness<N>(block, graph, k, threads); });
  return k;
}

NodeMatrix assemble_mass(const Solid& solid, const NodeGraph& graph, int threads) {
  NodeMatrix m{&graph, std::vector<double>(graph.neighbours.size(), 0.0)};
  for_each_block(solid, [&]<int N>(const SolidBlock& block) { add_mass<N>(block, graph, m, threads); });
  for (const Coating& coating : solid.coatings) add_coating(solid, coating, graph, m);
  return m;
}

}  // namespace bielle::reduce
