#include "reduce/matrices/inertia_loads.hpp"

#include <Eigen/Geometry>

#include "reduce/dense/dense_products.hpp"
#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

namespace {

constexpr int fields = 12;

/// Returns the displacements of the unknowns in the twelve fields (n, 12).
Eigen::MatrixXd linear_fields(const MatrixSet& set, const Eigen::Vector3d& origin) {
  Eigen::MatrixXd result(set.size(), fields);
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
    const Eigen::Vector3d along = set.axes[static_cast<std::size_t>(u.node)].col(u.component % 3);
    const Eigen::Vector3d x = set.positions.col(u.node) - origin;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) {
        const Eigen::Vector3d direction = Eigen::Vector3d::Unit(i);
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        if (j > 0) gradient(j - 1) = 1;
        result(k, 4 * i + j) =
            u.is_rotation() ? along.dot(gradient.cross(direction)) / 2 : along(i) * (j > 0 ? x(j - 1) : 1.0);
      }
  }
  return result;
}

}  // namespace

Eigen::MatrixXd inertia_loads(const MatrixSet& set, const NodeTies& ties, const MatrixBasis& basis,
                              const Eigen::Vector3d& origin) {
  if (set.scalars() == 0) return set.mass * linear_fields(set, origin);
  Superelement interfaces;  // rigid motions of the kept directions alone
  interfaces.interfaces = ties.interfaces;
  interfaces.stiffness.setZero(ties.carry.cols(), ties.carry.cols());
  return set.mass * product(basis.shapes.leftCols(ties.carry.cols()), rigid_coordinates(interfaces, origin));
}

InertiaAnswer inertia_answer_of(const MatrixSet& set, const NodeTies& ties, const HeldMatrices& held,
                                const MatrixBasis& basis, const Eigen::Vector3d& centre) {
  if (set.scalars() > 0) return {};
  const Eigen::MatrixXd loads = inertia_loads(set, ties, basis, centre);
  const Eigen::MatrixXd inside = ties.inside.transpose() * loads;
  const Eigen::MatrixXd whole = transposed_product(inside, held.solve(inside));
  InertiaAnswer answer;
  answer.whole = (whole + whole.transpose()) / 2;
  answer.missing = answer.whole;
  const Eigen::Index modes = basis.eigenvalues.size();
  if (modes == 0) return answer;
  const Eigen::MatrixXd participation = basis.eigenvalues.cwiseSqrt().cwiseInverse().asDiagonal() *
                                        transposed_product(basis.shapes.rightCols(modes), loads);
  answer.missing -= transposed_product(participation, participation);
  answer.missing = Eigen::MatrixXd(answer.missing + answer.missing.transpose()) / 2;
  return answer;
}

}  // namespace bielle::reduce
