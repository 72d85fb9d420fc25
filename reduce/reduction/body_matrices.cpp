#include "reduce/reduction/body_matrices.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <utility>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/fe/geometric_stiffness.hpp"

namespace bielle::reduce {

namespace {

class FactorHere : public InsideFactor {
 public:
  FactorHere(const BorderedPart& matrix, std::shared_ptr<const FactorStructure> structure, int threads)
      : factor_(matrix, std::move(structure), threads) {}
  const FactorStatistics& statistics() const override { return factor_.statistics(); }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& f) const override { return factor_.solve(f); }
  std::optional<PivotSigns> count_signs(SymmetricMatrix matrix, const std::vector<double>& scale) const override {
    return factor_.count_signs(std::move(matrix), scale);
  }

 private:
  SymmetricFactor factor_;
};

/// Nothing where no unknown is left.
std::shared_ptr<const FactorStructure> structure_of(const BlockGraph& points, const InsideUnknowns& inside) {
  const BlockGraph graph = inside_graph(points, inside);
  return graph.unknowns() == 0 ? nullptr : std::make_shared<const FactorStructure>(graph);
}

class MatricesHere : public BodyMatrices {
 public:
  MatricesHere(const Solid& solid, const InsideUnknowns& inside, int threads)
      : solid_(solid),
        threads_(threads),
        graph_(node_graph(solid.nodes, solid.points(), threads)),
        prepared_for_(inside) {
    const int others = std::max(1, threads - 1);
    // The stiffness goes to another thread, where there is one to be had, since METIS catches signals of its own.
    std::future<void> assembly =
        std::async(threads > 1 ? std::launch::async | std::launch::deferred : std::launch::deferred,
                   [&] { stiffness_ = assemble_stiffness(solid, graph_, others); });
    structure_ = structure_of(point_graph(graph_), inside);
    const bool is_busy = assembly.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
    if (!is_busy) assembly.get();
    try {
      mass_ = assemble_mass(solid, graph_, is_busy ? 1 : threads);
    } catch (const ComputationError&) {
      if (is_busy) assembly.get();  // what is wrong with the stiffness comes first, whoever finds it first
      throw;
    }
    if (is_busy) assembly.get();
  }
  MatricesHere(const MatricesHere&) = delete;
  MatricesHere& operator=(const MatricesHere&) = delete;

  RowMatrix stiffness_times(const RowMatrix& u) const override { return stiffness_.multiply(u, threads_); }
  Eigen::VectorXd stiffness_diagonal() const override { return stiffness_.diagonal(); }
  RowMatrix mass_times(const RowMatrix& u, int rows_per_node) const override {
    return mass_.multiply(u, rows_per_node, threads_);
  }
  const SymmetricMatrix* stiffness_here() const override { return &stiffness_; }
  const NodeMatrix* mass_here() const override { return &mass_; }
  std::vector<Eigen::MatrixXd> geometric_stiffness(const RowMatrix& fields, const RowMatrix& shapes) const override {
    return reduced_geometric_stiffness(solid_, graph_, fields, shapes, threads_);
  }
  std::unique_ptr<InsideFactor> factorise(const InsideUnknowns& inside) const override {
    return factorise_inside(stiffness_, inside, inside.is_like(prepared_for_) ? structure_ : nullptr, threads_);
  }

 private:
  const Solid& solid_;
  int threads_;
  NodeGraph graph_;
  SymmetricMatrix stiffness_;
  NodeMatrix mass_;
  InsideUnknowns prepared_for_;
  std::shared_ptr<const FactorStructure> structure_;
};

}  // namespace

std::unique_ptr<BodyMatrices> assembled_matrices(const Solid& solid, const InsideUnknowns& inside, int threads) {
  return std::make_unique<MatricesHere>(solid, inside, threads);
}

std::unique_ptr<InsideFactor> factorise_inside(const SymmetricMatrix& stiffness, const InsideUnknowns& inside,
                                               std::shared_ptr<const FactorStructure> structure, int threads) {
  if (!structure) structure = structure_of(point_graph(stiffness), inside);
  if (!structure) return nullptr;
  BorderedPart matrix{stiffness, inside.kept, {}, {}};
  if (inside.carried.cols() > 0) {
    const RowMatrix forces = stiffness.multiply(RowMatrix(inside.carried), threads);
    matrix.border = forces(inside.kept, Eigen::all);
    matrix.corner = inside.carried.transpose() * forces;
  }
  return std::make_unique<FactorHere>(matrix, std::move(structure), threads);
}

}  // namespace bielle::reduce
