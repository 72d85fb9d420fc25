// Cells with N nodes at the points of a quadrature rule: local shape functions tabulated once, mapped cell by cell.
// Internal to reduce/fe.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "reduce/fe/node_graph.hpp"
#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"

namespace bielle::reduce {

template <int N>
using CellPoints = Eigen::Matrix<double, 3, N>;

/// Shape functions of a type of tetrahedron at the points of a rule.
template <int N>
struct CellRule {
  static constexpr CellType type = N == 4 ? CellType::tet4 : CellType::tet10;
  std::vector<Eigen::Matrix<double, N, 1>> values;
  std::vector<Eigen::Matrix<double, N, 3>> local_gradients;
  Eigen::VectorXd weights;
  Eigen::MatrixXd points;

  explicit CellRule(const Quadrature& rule) : weights(rule.weights), points(rule.points) {
    for (Eigen::Index p = 0; p < weights.size(); ++p) {
      values.push_back(shape_values(type, rule.points.col(p)));
      local_gradients.push_back(shape_gradients(type, rule.points.col(p)));
    }
  }
  std::size_t size() const { return values.size(); }
};

/// Gradients dN_a/dx_j at point p [1/m] and weight times Jacobian [m^3]; a Jacobian <= 0 means that the cell is
/// inverted.
template <int N>
double map_point(const CellRule<N>& rule, std::size_t p, const CellPoints<N>& x,
                 Eigen::Matrix<double, N, 3>& gradients) {
  const Eigen::Matrix3d jacobian = x * rule.local_gradients[p];  // dx_i/dxi_k
  gradients.noalias() = rule.local_gradients[p] * jacobian.inverse();
  return rule.weights(p) * jacobian.determinant();
}

/// Mid-side nodes in the middle of their edges: the Jacobian is constant.
template <int N>
bool is_straight(const CellPoints<N>& x) {
  if constexpr (N == 4) {
    return true;
  } else {
    int node = 4;
    for (const auto& [a, b] : cell_info(CellType::tet10).edges)
      if ((x.col(node++) - (x.col(a) + x.col(b)) / 2).squaredNorm() > 1e-20 * (x.col(b) - x.col(a)).squaredNorm())
        return false;
    return true;
  }
}

/// Degrees of the rules that integrate exactly on a straight cell, and polynomial integrands exactly on a curved one.
struct CellDegrees {
  int straight, curved;
};

/// The rules for straight and for curved cells for one purpose.
template <int N>
struct CellRules {
  CellRule<N> straight, curved;
  explicit CellRules(CellDegrees degrees)
      : straight(simplex_quadrature(3, degrees.straight)), curved(simplex_quadrature(3, degrees.curved)) {}
  const CellRule<N>& of(const CellPoints<N>& x) const { return is_straight<N>(x) ? straight : curved; }
};

/// Calls work(cell) for every cell; cells of one colour run at the same time.
template <typename Work>
void for_each_cell(const Eigen::MatrixXi& nodes, Eigen::Index points, int threads, const Work& work) {
  for (const std::vector<int>& cells : colour_cells(nodes, points)) {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t k = 0; k < cells.size(); ++k) {
      work(cells[k]);
    }
  }
}

template <int N>
CellPoints<N> cell_points(const Eigen::Matrix3Xd& points, const Eigen::MatrixXi& nodes, Eigen::Index cell) {
  CellPoints<N> x;
  for (int a = 0; a < N; ++a) {
    x.col(a) = points.col(nodes(a, cell));
  }
  return x;
}

}  // namespace bielle::reduce
