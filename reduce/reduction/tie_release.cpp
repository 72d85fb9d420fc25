#include "reduce/reduction/tie_release.hpp"

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::reduce {

namespace {

constexpr int steps = 4;

/// The nodes of one rigid tie, with the projection on displacements whose mean motion is zero, and its transpose.
class Surface {
 public:
  Surface(const TiedSurface& surface, const Interface& interface) {
    const auto nodes = static_cast<Eigen::Index>(surface.nodes.size());
    conditions_.resize(3 * nodes, 6);
    for (int axis = 0; axis < 6; ++axis)
      conditions_.col(axis) = spread_unit_load(surface.integrals, interface, axis).reshaped();
    for (int axis = 0; axis < 6; ++axis) conditions_.col(axis).normalize();
    normal_ = transposed_product(conditions_, conditions_);
    for (const int node : surface.nodes) rows_.insert(rows_.end(), {3 * node, 3 * node + 1, 3 * node + 2});
  }

  const std::vector<int>& rows() const { return rows_; }

  /// Returns P x for the surface's rows x of a field.
  Eigen::MatrixXd projected(const RowMatrix& field) const {
    const Eigen::MatrixXd x = field(rows_, Eigen::all);
    return x - product(conditions_, solve_symmetric(normal_, transposed_product(conditions_, x)));
  }

 private:
  std::vector<int> rows_;
  Eigen::MatrixXd conditions_;  // C^T (3 nodes, 6)
  Eigen::MatrixXd normal_;      // C C^T (6, 6)
};

/// Returns the projections of a field on the surfaces; other rows are zero.
RowMatrix projected(const std::vector<Surface>& surfaces, const RowMatrix& field) {
  RowMatrix result = RowMatrix::Zero(field.rows(), field.cols());
  for (const Surface& surface : surfaces) result(surface.rows(), Eigen::all) = surface.projected(field);
  return result;
}

Eigen::RowVectorXd dots(const RowMatrix& a, const RowMatrix& b) { return a.cwiseProduct(b).colwise().sum(); }

/// Returns a / b, or 0 if b is zero.
Eigen::RowVectorXd ratios(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b) {
  return (b.array() > 0).select(a.array() / b.array(), 0);
}

}  // namespace

RowMatrix deformation_without_rigid_ties(const FullModel& model, const RowMatrix& forces) {
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < model.ties.surfaces.size(); ++i)
    if (model.ties.surfaces[i].tie == Tie::rigid)
      surfaces.emplace_back(model.ties.surfaces[i], model.ties.interfaces[i]);
  if (surfaces.empty()) return RowMatrix(forces.rows(), 0);

  const Eigen::VectorXd diagonal = model.matrices.stiffness_diagonal().cwiseMax(1e-300).cwiseInverse();
  const auto preconditioned = [&](const RowMatrix& r) { return projected(surfaces, diagonal.asDiagonal() * r); };
  RowMatrix residual = projected(surfaces, -forces), z = preconditioned(residual), direction = z;
  RowMatrix answer = RowMatrix::Zero(forces.rows(), forces.cols());
  Eigen::RowVectorXd size = dots(residual, z);
  for (int step = 0; step < steps; ++step) {
    const Eigen::MatrixXd inside = model.held.solve(model.held.restrict(model.matrices.stiffness_times(direction)));
    const RowMatrix y = direction - model.held.expand(inside), forces_of_y = model.matrices.stiffness_times(y);
    const Eigen::RowVectorXd length = ratios(size, dots(direction, forces_of_y));
    answer += y * length.asDiagonal();
    if (step + 1 == steps) break;
    residual -= projected(surfaces, forces_of_y) * length.asDiagonal();
    z = preconditioned(residual);
    const Eigen::RowVectorXd next = dots(residual, z);
    direction = z + direction * ratios(next, size).asDiagonal();
    size = next;
  }
  return answer;
}

}  // namespace bielle::reduce
