#include "reduce/fe/mean_strain.hpp"

#include "reduce/fe/solid_block.hpp"

namespace bielle::reduce {

namespace {

/// Adds the integrals of the gradient of each node's shape function, (3, points), and the volume.
template <int N>
void add_gradients(const SolidBlock& block, Eigen::Matrix3Xd& sums, double& volume) {
  // Gradient times Jacobian is a product of local gradients, three of them on a curved cell.
  const CellRules<N> rules(SolidCell<N>::is_simplex        ? CellDegrees{1, 3}
                           : SolidCell<N>::is_second_order ? CellDegrees{2, 6}
                                                           : CellDegrees{2, 3});
  Eigen::Matrix<double, N, 3> gradients;
  for (Eigen::Index cell = 0; cell < block.cells(); ++cell) {
    const CellPoints<N> x = block.points<N>(cell);
    const CellRule<N>& rule = rules.of(x);
    for (std::size_t p = 0; p < rule.size(); ++p) {
      const double part = map_point(rule, p, x, gradients);
      volume += part;
      for (int a = 0; a < N; ++a) sums.col(block.nodes(a, cell)) += part * gradients.row(a).transpose();
    }
  }
}

}  // namespace

Eigen::MatrixXd mean_strain(const Solid& solid, const RowMatrix& fields) {
  Eigen::Matrix3Xd gradients = Eigen::Matrix3Xd::Zero(3, solid.points());
  double volume = 0;
  for_each_block(solid, [&]<int N>(const SolidBlock& block) { add_gradients<N>(block, gradients, volume); });
  gradients /= volume;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(6, fields.cols());
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    const auto x = fields.row(3 * a), y = fields.row(3 * a + 1), z = fields.row(3 * a + 2);
    const Eigen::Vector3d g = gradients.col(a);
    if (g.isZero(0)) continue;
    result.row(0) += g.x() * x;
    result.row(1) += g.y() * y;
    result.row(2) += g.z() * z;
    result.row(3) += g.z() * y + g.y() * z;
    result.row(4) += g.z() * x + g.x() * z;
    result.row(5) += g.y() * x + g.x() * y;
  }
  return result;
}

}  // namespace bielle::reduce
