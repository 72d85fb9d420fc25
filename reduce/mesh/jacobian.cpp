#include "reduce/mesh/jacobian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"

namespace bielle::reduce {

namespace {

// Exponents (i,j,k,l), i + j + k + l = degree, of the Bernstein polynomials of a tetrahedron, and their table.
using Exponents = std::array<int, 4>;

constexpr int index_of(const Exponents& e) {  // a number below 64 for degree <= 3
  return e[1] + 4 * e[2] + 16 * e[3];
}

// A gradient dx/dxi_c of a tet10 is linear: its four corner values are its Bernstein coefficients.
// x = sum_a x_a (2 L_a - 1) L_a + sum_(ab) 4 x_ab L_a L_b; at corner p: d x/d L_a = x_a (4 d_ap - 1) + sum_b 4 x_ab
// d_bp.
std::array<Eigen::Matrix3d, 4> corner_gradients(const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  std::array<Eigen::Matrix3d, 4> gradients;
  for (int p = 0; p < 4; ++p) {
    Eigen::Matrix<double, 3, 4> by_barycentric;
    for (int a = 0; a < 4; ++a) by_barycentric.col(a) = x.col(a) * (a == p ? 3.0 : -1.0);
    for (int k = 0; k < 6; ++k) {
      const auto [a, b] = std::pair(tet_edges[k][0], tet_edges[k][1]);
      if (b == p) by_barycentric.col(a) += 4 * x.col(4 + k);
      if (a == p) by_barycentric.col(b) += 4 * x.col(4 + k);
    }
    for (int c = 0; c < 3; ++c) gradients[p].col(c) = by_barycentric.col(c + 1) - by_barycentric.col(0);
  }
  return gradients;
}

double triple(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.cross(b).dot(c);
}

}  // namespace

double straight_determinant(const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  return triple(x.col(1) - x.col(0), x.col(2) - x.col(0), x.col(3) - x.col(0));
}

Eigen::Matrix<double, 20, 1> determinant_coefficients(const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  const std::array<Eigen::Matrix3d, 4> g = corner_gradients(x);
  // det = sum over corners p, q, r of L_p L_q L_r det(g1_p, g2_q, g3_r). The number of products that give one monomial
  // is its multinomial coefficient 3!/(i! j! k! l!), which is a factor of the Bernstein polynomial: its coefficient is
  // therefore the mean of these products.
  std::array<double, 64> sum{};
  std::array<int, 64> products{};
  for (int p = 0; p < 4; ++p)
    for (int q = 0; q < 4; ++q) {
      const Eigen::Vector3d normal = g[p].col(0).cross(g[q].col(1));
      for (int r = 0; r < 4; ++r) {
        Exponents e{};
        ++e[p], ++e[q], ++e[r];
        sum[index_of(e)] += normal.dot(g[r].col(2));
        ++products[index_of(e)];
      }
    }
  Eigen::Matrix<double, 20, 1> coefficients;
  int next = 0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (products[i] > 0) coefficients[next++] = sum[i] / products[i];
  return coefficients;
}

namespace {

bool is_tetrahedron(const CellInfo& cell) { return cell.dimension == 3 && cell.vertices == 4; }

// Gradients of the shape functions at some places of a reference cell, and the weights of a rule.
struct GradientTable {
  std::vector<Eigen::MatrixXd> gradients;
  Eigen::VectorXd weights;
};

GradientTable gradient_table(CellType type, const Quadrature& rule) {
  GradientTable table;
  for (const auto& xi : rule.points.colwise()) table.gradients.push_back(shape_gradients(type, xi));
  table.weights = rule.weights;
  return table;
}

// Tables of all solid types, made once.
template <class Rule>
std::map<CellType, GradientTable> gradient_tables(const Rule& rule_of) {
  std::map<CellType, GradientTable> tables;
  for (const CellInfo& cell : cell_table())
    if (cell.dimension == 3) tables[cell.type] = gradient_table(cell.type, rule_of(cell));
  return tables;
}

// A rule that integrates det(dx/dxi) exactly. Along one coordinate of the reference cell the gradient with respect to
// it has degree order - 1, the other two have `order`; those of pyramids have `order` in x/(1 - z) and y/(1 - z).
Quadrature volume_rule(const CellInfo& cell) {
  return cell_quadrature(cell.type, cell.vertices == 5 ? 3 * cell.order : 3 * cell.order - 1);
}

Quadrature places_of_check(const CellInfo& cell) {
  CellType richest = cell.type;
  for (const CellInfo& other : cell_table())
    if (other.dimension == 3 && other.vertices == cell.vertices && other.nodes > node_count(richest))
      richest = other.type;
  Eigen::MatrixXd nodes = local_nodes(richest);
  if (cell.vertices == 5) {  // without the apex
    nodes.col(4) = nodes.rightCols<1>();
    nodes.conservativeResize(3, nodes.cols() - 1);
  }
  const Quadrature rule = cell_quadrature(cell.type, 4);
  Quadrature places{Eigen::MatrixXd(3, nodes.cols() + rule.points.cols()), {}};
  places.points << nodes, rule.points;
  return places;
}

Eigen::VectorXd determinants(const GradientTable& table, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  Eigen::VectorXd result(table.gradients.size());
  for (std::size_t p = 0; p < table.gradients.size(); ++p) {
    const Eigen::MatrixXd& gradients = table.gradients[p];
    const Eigen::Matrix3d jacobian = x.leftCols(gradients.rows()) * gradients;
    result[static_cast<Eigen::Index>(p)] = triple(jacobian.col(0), jacobian.col(1), jacobian.col(2));
  }
  return result;
}

// A vertex and three vertices at the other ends of its edges, right-handed in a cell that is not inverted.
using EdgeTriple = std::array<int, 4>;

std::vector<EdgeTriple> edge_triples(const CellInfo& cell) {
  const Eigen::Matrix3Xd x = local_nodes(cell.type);
  std::vector<EdgeTriple> result;
  for (int p = 0; p < cell.vertices; ++p) {
    std::vector<int> ends;
    for (const auto& [a, b] : cell.edges)
      if (a == p || b == p) ends.push_back(a == p ? b : a);
    const std::size_t count = ends.size();
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        for (std::size_t k = j + 1; k < count; ++k) {
          EdgeTriple triple_at{p, ends[i], ends[j], ends[k]};
          if (triple(x.col(ends[i]) - x.col(p), x.col(ends[j]) - x.col(p), x.col(ends[k]) - x.col(p)) < 0)
            std::swap(triple_at[2], triple_at[3]);
          result.push_back(triple_at);
        }
  }
  return result;
}

double scaled_jacobian_of_tetrahedron(const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  const double determinant = straight_determinant(x);
  double least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < 4; ++p) {
    double edges = 1;
    for (int q = 0; q < 4; ++q)
      if (q != p) edges *= (x.col(q) - x.col(p)).norm();
    least = std::min(least, edges > 0 ? std::sqrt(2.0) * determinant / edges : 0.0);
  }
  return least;
}

}  // namespace

CellType straight_type(CellType type) {
  const CellInfo& cell = cell_info(type);
  for (const CellInfo& other : cell_table())
    if (other.order == 1 && other.dimension == cell.dimension && other.vertices == cell.vertices) return other.type;
  return type;
}

Eigen::VectorXd checked_determinants(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  const CellInfo& cell = cell_info(type);
  if (is_tetrahedron(cell))
    return cell.order == 1 ? Eigen::VectorXd::Constant(1, straight_determinant(x))
                           : Eigen::VectorXd(determinant_coefficients(x));
  static const std::map<CellType, GradientTable> tables = gradient_tables(places_of_check);
  return determinants(tables.at(type), x);
}

double cell_volume(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  const CellInfo& cell = cell_info(type);
  if (is_tetrahedron(cell)) return (cell.order == 2 ? determinant_coefficients(x).mean() : straight_determinant(x)) / 6;
  static const std::map<CellType, GradientTable> tables = gradient_tables(volume_rule);
  const GradientTable& table = tables.at(type);
  return table.weights.dot(determinants(table, x));
}

double scaled_jacobian(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  const CellInfo& cell = cell_info(type);
  if (is_tetrahedron(cell)) return scaled_jacobian_of_tetrahedron(x);
  static const std::map<int, std::vector<EdgeTriple>> triples = {{8, edge_triples(cell_info(CellType::hex8))},
                                                                 {6, edge_triples(cell_info(CellType::wedge6))},
                                                                 {5, edge_triples(cell_info(CellType::pyramid5))}};
  const double factor = cell.vertices == 8 ? 1 : cell.vertices == 6 ? 2 / std::sqrt(3.0) : std::sqrt(2.0);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [p, i, j, k] : triples.at(cell.vertices)) {
    const Eigen::Vector3d a = x.col(i) - x.col(p), b = x.col(j) - x.col(p), c = x.col(k) - x.col(p);
    const double edges = a.norm() * b.norm() * c.norm();
    least = std::min(least, edges > 0 ? factor * triple(a, b, c) / edges : 0.0);
  }
  return least;
}

}  // namespace bielle::reduce
