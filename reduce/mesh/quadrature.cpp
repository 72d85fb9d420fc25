#include "reduce/mesh/quadrature.hpp"

#include <cmath>

#include <Eigen/Core>

#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle::reduce {

namespace {

struct Rule {
  Eigen::VectorXd points, weights;
};

/// Returns the n-point Gauss-Jacobi rule on [0,1] for the weight (1 - x)^a, degree 2n - 1: eigenvalues of the Jacobi
/// matrix (G. H. Golub, J. H. Welsch, Math. Comp. 23 (1969) 221).
Rule gauss_jacobi(int n, int a) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    const double s = 2 * k + a;
    jacobi(k, k) = k == 0 ? -a / (a + 2.0) : -double(a * a) / (s * (s + 2));
    if (k > 0) {
      const double p = 4.0 * k * k * (k + a) * (k + a) / (s * s * (s + 1) * (s - 1));
      jacobi(k, k - 1) = jacobi(k - 1, k) = std::sqrt(p);
    }
  }
  const SymmetricEigenpairs eigen = symmetric_eigenpairs(jacobi);
  return {(1 + eigen.values.array()) / 2, eigen.vectors.row(0).array().square().transpose() / (a + 1)};
}

Quadrature four_points() {
  const double a = (5 - std::sqrt(5.0)) / 20, b = 1 - 3 * a;
  Quadrature rule;
  rule.points = Eigen::MatrixXd::Constant(3, 4, a);
  rule.points.rightCols<3>().diagonal().setConstant(b);
  rule.weights = Eigen::VectorXd::Constant(4, 1.0 / 24);
  return rule;
}

}  // namespace

Quadrature simplex_quadrature(int dimension, int degree) {
  if (dimension == 3 && degree == 2) {
    return four_points();
  }
  const int n = degree / 2 + 1;
  // x = u, y = v (1 - u), z = w (1 - u)(1 - v): the Jacobian (1 - u)^(d-1) (1 - v)^(d-2) goes into the rules' weights.
  Quadrature rule{Eigen::MatrixXd::Zero(dimension, 1), Eigen::VectorXd::Ones(1)};
  Eigen::VectorXd left = Eigen::VectorXd::Ones(1);  // 1 minus the coordinates so far
  for (int k = 0; k < dimension; ++k) {
    const Rule line = gauss_jacobi(n, dimension - 1 - k);
    const Eigen::Index points = rule.weights.size();
    Quadrature finer{Eigen::MatrixXd(dimension, points * n), Eigen::VectorXd(points * n)};
    Eigen::VectorXd finer_left(points * n);
    for (Eigen::Index p = 0; p < points; ++p) {
      for (int q = 0; q < n; ++q) {
        finer.points.col(p * n + q) = rule.points.col(p);
        finer.points(k, p * n + q) = left(p) * line.points(q);
        finer.weights(p * n + q) = rule.weights(p) * line.weights(q);
        finer_left(p * n + q) = left(p) * (1 - line.points(q));
      }
    }
    rule = std::move(finer);
    left = std::move(finer_left);
  }
  return rule;
}

namespace {

/// Combines every point of one rule with every point of another one, whose coordinates come last.
Quadrature product(const Quadrature& first, const Quadrature& second) {
  const Eigen::Index n = first.weights.size(), m = second.weights.size(), d = first.points.rows();
  Quadrature all{Eigen::MatrixXd(d + second.points.rows(), n * m), Eigen::VectorXd(n * m)};
  for (Eigen::Index p = 0; p < n; ++p)
    for (Eigen::Index q = 0; q < m; ++q) {
      all.points.col(p * m + q) << first.points.col(p), second.points.col(q);
      all.weights(p * m + q) = first.weights(p) * second.weights(q);
    }
  return all;
}

/// Gauss's rule on [-1, 1].
Quadrature line_quadrature(int degree) {
  const Rule unit = gauss_jacobi(degree / 2 + 1, 0);
  return {(2 * unit.points.array() - 1).matrix().transpose(), 2 * unit.weights};
}

/// Returns points (a (1 - z), b (1 - z), z) with a, b on [-1, 1]: the Jacobian (1 - z)^2 goes into the weights of z.
Quadrature pyramid_quadrature(int degree) {
  const Rule height = gauss_jacobi(degree / 2 + 1, 2);
  const Quadrature line = line_quadrature(degree);
  Quadrature rule = product(product(line, line), {height.points.transpose(), height.weights});
  rule.points.topRows(2).array().rowwise() *= 1 - rule.points.row(2).array();
  return rule;
}

}  // namespace

Quadrature cell_quadrature(CellType type, int degree) {
  const CellInfo& cell = cell_info(type);
  if (cell.vertices == cell.dimension + 1) return simplex_quadrature(cell.dimension, degree);
  const Quadrature line = line_quadrature(degree);
  if (cell.vertices == 6) return product(simplex_quadrature(2, degree), line);
  if (cell.vertices == 5) return pyramid_quadrature(degree);
  return cell.dimension == 2 ? product(line, line) : product(product(line, line), line);
}

}  // namespace bielle::reduce
