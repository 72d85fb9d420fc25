#include "reduce/reduction/body_matrices.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <utility>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/fe/geometric_stiffness.hpp"
#include "reduce/fe/node_graph.hpp"
#include "reduce/sparse/dense_factor.hpp"
#include "reduce/sparse/symmetric_factor.hpp"

namespace bielle::reduce {

namespace {

std::int64_t unknowns_of(const InteriorUnknowns& interior) {
  return static_cast<std::int64_t>(interior.kept.size()) + interior.carried.cols();
}

/// Returns nothing if the factor is dense and needs no structure.
std::shared_ptr<const FactorStructure> structure_of(const BlockGraph& points, const InteriorUnknowns& interior) {
  if (unknowns_of(interior) <= most_dense_unknowns) return nullptr;
  return std::make_shared<const FactorStructure>(interior_graph(points, interior));
}

/// Computes K_ii - sigma M_ii. @param kept  unknowns x y z of points, ascending
void subtract_inertia(SymmetricMatrix& matrix, const std::vector<std::int64_t>& kept, const NodeMatrix& mass,
                      double sigma, int threads) {
#pragma omp parallel for schedule(dynamic, 1024) num_threads(threads)
  for (std::int64_t j = 0; j < matrix.size; ++j) {
    const std::int64_t column = kept[static_cast<std::size_t>(j)], a = column / 3;
    for (std::int64_t p = matrix.starts[j]; p < matrix.starts[j + 1]; ++p) {
      const std::int64_t row = kept[static_cast<std::size_t>(matrix.rows[p])];
      if (row % 3 != column % 3) continue;
      const std::int64_t at = mass.graph->place(static_cast<int>(a), static_cast<int>(row / 3));
      matrix.values[p] -= sigma * mass.values[static_cast<std::size_t>(at)];
    }
  }
}

class MatricesHere : public BodyMatrices {
 public:
  MatricesHere(const Solid& solid, const InteriorUnknowns& interior, int threads)
      : solid_(solid), threads_(threads), graph_(node_graph(solid.mesh, threads)), prepared_for_(interior) {
    const int others = std::max(1, threads - 1);
    // The stiffness is assembled in another thread, if available, since METIS catches signals of its own.
    std::future<void> assembly =
        std::async(threads > 1 ? std::launch::async | std::launch::deferred : std::launch::deferred,
                   [&] { stiffness_ = assemble_stiffness(solid, graph_, others); });
    structure_ = structure_of(point_graph(graph_), interior);
    const bool is_busy = assembly.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
    if (!is_busy) assembly.get();
    try {
      mass_ = assemble_mass(solid, graph_, is_busy ? 1 : threads);
    } catch (const ComputationError&) {
      if (is_busy) assembly.get();  // report an error in the stiffness first
      throw;
    }
    if (is_busy) assembly.get();
  }
  MatricesHere(const MatricesHere&) = delete;
  MatricesHere& operator=(const MatricesHere&) = delete;

  RowMatrix stiffness_times(const RowMatrix& u) const override { return stiffness_.multiply(u, threads_); }
  Eigen::VectorXd stiffness_diagonal() const override { return stiffness_.diagonal(); }
  RowMatrix mesh_mass_times(const RowMatrix& u, int rows_per_node) const override {
    return mass_.multiply(u, rows_per_node, threads_);
  }
  std::vector<Eigen::MatrixXd> geometric_stiffness(const RowMatrix& fields, const RowMatrix& shapes) const override {
    return reduced_geometric_stiffness(solid_, graph_, fields, shapes, threads_);
  }
  std::unique_ptr<Factor> factorise(const InteriorUnknowns& interior) const override {
    if (unknowns_of(interior) == 0) return nullptr;
    const std::shared_ptr<const FactorStructure> structure =
        interior.is_like(prepared_for_) ? structure_ : structure_of(point_graph(graph_), interior);
    SymmetricMatrix matrix = principal_submatrix(stiffness_, interior.kept);
    if (interior.carried.cols() > 0) {
      const RowMatrix forces = stiffness_.multiply(RowMatrix(interior.carried), threads_);
      matrix = bordered(matrix, forces(interior.kept, Eigen::all), interior.carried.transpose() * forces);
    }
    if (!structure) return std::make_unique<DenseFactor>(matrix);
    return std::make_unique<SymmetricFactor>(structure, std::move(matrix), threads_);
  }
  bool can_count_signs() const override { return true; }
  std::optional<PivotSigns> count_mesh_signs(const Factor& factor, const BorderedShift& shifted) const override {
    SymmetricMatrix matrix = principal_submatrix(stiffness_, shifted.kept);
    subtract_inertia(matrix, shifted.kept, mass_, shifted.eigenvalue, threads_);
    if (shifted.corner.cols() > 0) matrix = bordered(matrix, shifted.border, shifted.corner);
    return factor.count_signs(matrix, shifted.scale);
  }

 private:
  const Solid& solid_;
  int threads_;
  NodeGraph graph_;
  SymmetricMatrix stiffness_;
  NodeMatrix mass_;
  InteriorUnknowns prepared_for_;
  std::shared_ptr<const FactorStructure> structure_;
};

}  // namespace

RowMatrix BodyMatrices::mass_times(const RowMatrix& u) const {
  RowMatrix products = mesh_mass_times(u);
  masses_.add_inertia(u, products);
  return products;
}

// The masses' part -sigma B B^T of the interior is full in the points of their surfaces. It is the Schur complement of
// a border: [A, sqrt(sigma) B; ., I] has the signs of A - sigma B B^T, and one positive one for each column of B.
std::optional<PivotSigns> BodyMatrices::count_signs(const Factor& factor, const BorderedShift& shifted) const {
  if (masses_.empty()) return count_mesh_signs(factor, shifted);
  BorderedShift all = shifted;
  const Eigen::MatrixXd root = std::sqrt(shifted.eigenvalue) * masses_.root_of_inertia(shifted.kept);
  const Eigen::Index rows = root.rows(), old = shifted.corner.cols(), more = root.cols();
  all.border.conservativeResize(rows, old + more);
  all.border.rightCols(more) = root;
  all.corner = Eigen::MatrixXd::Identity(old + more, old + more);
  if (old > 0) all.corner.topLeftCorner(old, old) = shifted.corner;
  all.scale.resize(shifted.scale.size() + static_cast<std::size_t>(more), 1.0);
  return count_mesh_signs(factor, all);
}

std::unique_ptr<BodyMatrices> assembled_matrices(const Solid& solid, const InteriorUnknowns& interior, int threads) {
  return std::make_unique<MatricesHere>(solid, interior, threads);
}

}  // namespace bielle::reduce
