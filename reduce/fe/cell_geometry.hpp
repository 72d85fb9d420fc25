// Cells with N nodes at the points of a quadrature rule: local shape functions tabulated once, mapped cell by cell. No
// two types of solid cells have the same number of nodes, so that N stands for the type. Internal to reduce/fe.
#pragma once

#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "reduce/fe/integration.hpp"
#include "reduce/fe/node_graph.hpp"
#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"

namespace bielle::reduce {

/// Calls work.operator()<N>() with the number of nodes of a type of solid cells.
template <class Work>
auto with_nodes_of(CellType type, const Work& work) {
  switch (type) {
    case CellType::tet4:
      return work.template operator()<4>();
    case CellType::tet10:
      return work.template operator()<10>();
    case CellType::hex8:
      return work.template operator()<8>();
    case CellType::hex20:
      return work.template operator()<20>();
    case CellType::hex27:
      return work.template operator()<27>();
    case CellType::wedge6:
      return work.template operator()<6>();
    case CellType::wedge15:
      return work.template operator()<15>();
    case CellType::pyramid5:
      return work.template operator()<5>();
    case CellType::pyramid13:
      return work.template operator()<13>();
    default:
      throw std::logic_error("no type of solid cells");
  }
}

/// Properties of the type with N nodes that are known at compile time.
template <int N>
struct SolidCell {
  static constexpr bool is_simplex = N == 4 || N == 10;
  static constexpr bool is_second_order = N == 10 || N == 13 || N == 15 || N == 20 || N == 27;
  static constexpr int vertices = N == 4 || N == 10 ? 4 : N == 5 || N == 13 ? 5 : N == 6 || N == 15 ? 6 : 8;
  static constexpr CellType type = N == 4    ? CellType::tet4
                                   : N == 5  ? CellType::pyramid5
                                   : N == 6  ? CellType::wedge6
                                   : N == 8  ? CellType::hex8
                                   : N == 10 ? CellType::tet10
                                   : N == 13 ? CellType::pyramid13
                                   : N == 15 ? CellType::wedge15
                                   : N == 20 ? CellType::hex20
                                             : CellType::hex27;
};

template <int N>
using CellPoints = Eigen::Matrix<double, 3, N>;

/// Shape functions of a type at the points of a rule.
template <int N>
struct CellRule {
  static constexpr CellType type = SolidCell<N>::type;
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

/// Jacobian dx_i/dxi_k at point p [m]. It is computed coefficient by coefficient, here and below: Eigen would pack
/// factors of this size into blocks, which takes longer than their product.
template <int N>
Eigen::Matrix3d jacobian_at(const CellRule<N>& rule, std::size_t p, const CellPoints<N>& x) {
  return x.lazyProduct(rule.local_gradients[p]);
}

/// Gradients dN_a/dx_j at point p [1/m] and weight times Jacobian [m^3]; a Jacobian <= 0 means that the cell is
/// inverted.
template <int N>
double map_point(const CellRule<N>& rule, std::size_t p, const CellPoints<N>& x,
                 Eigen::Matrix<double, N, 3>& gradients) {
  const Eigen::Matrix3d jacobian = jacobian_at<N>(rule, p, x), inverse = jacobian.inverse();
  gradients = rule.local_gradients[p].lazyProduct(inverse);
  return rule.weights(p) * jacobian.determinant();
}

/// Whether the Jacobian is constant: the mid-side nodes of a tetrahedron are in the middle of their edges, another cell
/// is the image of its reference cell under a linear map. @param x  points of the nodes (3, nodes of the type)
bool is_straight(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x);

/// Degrees of the rules for straight cells and for others, see cell_quadrature.
struct CellDegrees {
  int straight, curved;
};

/// The rules for straight and for other cells for one purpose.
template <int N>
struct CellRules {
  CellRule<N> straight, curved;
  explicit CellRules(CellDegrees degrees)
      : straight(cell_quadrature(SolidCell<N>::type, degrees.straight)),
        curved(cell_quadrature(SolidCell<N>::type, degrees.curved)) {}
  const CellRule<N>& of(const CellPoints<N>& x) const { return is_straight(SolidCell<N>::type, x) ? straight : curved; }
};

/// Degrees for the stiffness: exact for straight cells; the usual two or three points in each direction of others, by
/// their order.
template <int N>
constexpr CellDegrees stiffness_degrees(Integration integration = Integration::standard) {
  if constexpr (N == 4) return {0, 0};
  if constexpr (N == 10) return {2, 5};
  if constexpr (N == 20)
    if (integration == Integration::reduced) return {2, 2};
  return SolidCell<N>::is_second_order ? CellDegrees{4, 4} : CellDegrees{2, 2};
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
