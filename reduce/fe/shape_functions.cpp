#include "reduce/fe/shape_functions.hpp"

namespace bielle::reduce {

int vertex_count(CellType type) { return dimension(type) + 1; }

Eigen::Matrix2Xi edges_of(CellType type) {
  switch (type) {
    case CellType::tet10:
      return (Eigen::Matrix2Xi(2, 6) << 0, 1, 0, 0, 2, 1, 1, 2, 2, 3, 3, 3).finished();
    case CellType::tri6:
      return (Eigen::Matrix2Xi(2, 3) << 0, 1, 0, 1, 2, 2).finished();
    default:
      return Eigen::Matrix2Xi(2, 0);
  }
}

namespace {

Eigen::VectorXd barycentric(const Eigen::VectorXd& xi) {
  Eigen::VectorXd l(xi.size() + 1);
  l << 1 - xi.sum(), xi;
  return l;
}

/// dl_a/dxi_k
Eigen::MatrixXd barycentric_gradients(Eigen::Index local_dimension) {
  Eigen::MatrixXd g(local_dimension + 1, local_dimension);
  g << Eigen::RowVectorXd::Constant(local_dimension, -1), Eigen::MatrixXd::Identity(local_dimension, local_dimension);
  return g;
}

}  // namespace

Eigen::VectorXd shape_values(CellType type, const Eigen::VectorXd& xi) {
  const Eigen::VectorXd l = barycentric(xi);
  const Eigen::Matrix2Xi edges = edges_of(type);
  if (edges.cols() == 0) {
    return l;
  }
  Eigen::VectorXd n(l.size() + edges.cols());
  n.head(l.size()) = l.array() * (2 * l.array() - 1);
  for (Eigen::Index e = 0; e < edges.cols(); ++e) {
    n(l.size() + e) = 4 * l(edges(0, e)) * l(edges(1, e));
  }
  return n;
}

Eigen::MatrixXd shape_gradients(CellType type, const Eigen::VectorXd& xi) {
  const Eigen::VectorXd l = barycentric(xi);
  const Eigen::MatrixXd dl = barycentric_gradients(xi.size());
  const Eigen::Matrix2Xi edges = edges_of(type);
  if (edges.cols() == 0) {
    return dl;
  }
  Eigen::MatrixXd dn(l.size() + edges.cols(), xi.size());
  dn.topRows(l.size()) = (4 * l.array() - 1).matrix().asDiagonal() * dl;
  for (Eigen::Index e = 0; e < edges.cols(); ++e) {
    const int a = edges(0, e), b = edges(1, e);
    dn.row(l.size() + e) = 4 * (l(a) * dl.row(b) + l(b) * dl.row(a));
  }
  return dn;
}

}  // namespace bielle::reduce
