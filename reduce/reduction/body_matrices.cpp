#include "reduce/reduction/body_matrices.hpp"

#include "reduce/fe/assembly.hpp"
#include "reduce/fe/geometric_stiffness.hpp"

namespace bielle::reduce {

namespace {

class FactorHere : public InsideFactor {
 public:
  FactorHere(const SymmetricMatrix& matrix, const std::vector<std::int64_t>& block_starts, int threads)
      : factor_(matrix, block_starts, threads) {}
  const FactorStatistics& statistics() const override { return factor_.statistics(); }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& f) const override { return factor_.solve(f); }
  std::optional<PivotSigns> count_signs(SymmetricMatrix matrix, const std::vector<double>& scale) const override {
    return factor_.count_signs(std::move(matrix), scale);
  }

 private:
  SymmetricFactor factor_;
};

class MatricesHere : public BodyMatrices {
 public:
  MatricesHere(const Solid& solid, int threads)
      : solid_(solid),
        threads_(threads),
        graph_(node_graph(solid.nodes, solid.points(), threads)),
        stiffness_(assemble_stiffness(solid, graph_, threads)),
        mass_(assemble_mass(solid, graph_, threads)) {}
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
  std::unique_ptr<InsideFactor> factorise(const std::vector<std::int64_t>& kept,
                                          const SparseRows& carried) const override {
    return factorise_inside(stiffness_, kept, carried, threads_);
  }

 private:
  const Solid& solid_;
  int threads_;
  NodeGraph graph_;
  SymmetricMatrix stiffness_;
  NodeMatrix mass_;
};

}  // namespace

std::unique_ptr<BodyMatrices> assembled_matrices(const Solid& solid, int threads) {
  return std::make_unique<MatricesHere>(solid, threads);
}

std::unique_ptr<InsideFactor> factorise_inside(const SymmetricMatrix& stiffness, const std::vector<std::int64_t>& kept,
                                               const SparseRows& carried, int threads) {
  std::vector<std::int64_t> block_starts;
  std::int64_t last_point = -1;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] / 3 == last_point) continue;
    last_point = kept[k] / 3;
    block_starts.push_back(static_cast<std::int64_t>(k));
  }
  SymmetricMatrix matrix = principal_submatrix(stiffness, kept);
  if (const Eigen::Index released = carried.cols(); released > 0) {
    const RowMatrix forces = stiffness.multiply(RowMatrix(carried), threads);
    Eigen::MatrixXd border(matrix.size, released);
    for (std::int64_t k = 0; k < matrix.size; ++k) {
      border.row(k) = forces.row(kept[k]);
    }
    matrix = bordered(matrix, border, Eigen::MatrixXd(carried.transpose() * forces));
    for (Eigen::Index c = 0; c < released; ++c) {
      block_starts.push_back(static_cast<std::int64_t>(kept.size()) + c);
    }
  }
  block_starts.push_back(matrix.size);
  if (matrix.size == 0) return nullptr;
  return std::make_unique<FactorHere>(matrix, block_starts, threads);
}

}  // namespace bielle::reduce
