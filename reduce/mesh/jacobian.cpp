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

/// A vertex at which three edges meet, with its neighbours in the order that makes their triple product positive.
struct Corner {
  int vertex;
  std::array<int, 3> neighbours;
};

std::vector<Corner> make_corners(const CellInfo& cell) {
  const Eigen::MatrixXd x = local_nodes(cell.type);
  std::vector<Corner> corners;
  for (int v = 0; v < cell.vertices; ++v) {
    std::vector<int> around;
    for (const auto& [a, b] : cell.edges)
      if (a == v || b == v) around.push_back(a == v ? b : a);
    if (around.size() != 3) continue;
    if (triple(x.col(around[0]) - x.col(v), x.col(around[1]) - x.col(v), x.col(around[2]) - x.col(v)) < 0)
      std::swap(around[1], around[2]);
    corners.push_back({v, {around[0], around[1], around[2]}});
  }
  return corners;
}

const std::vector<Corner>& corners_of(CellType type) {
  static const std::map<CellType, std::vector<Corner>> of_types = [] {
    std::map<CellType, std::vector<Corner>> all;
    for (const CellInfo& cell : cell_table())
      if (cell.dimension == 3) all.emplace(cell.type, make_corners(cell));
    return all;
  }();
  return of_types.at(type);
}

/// Gradients of the shape functions at the points of a rule, and the weights.
struct Tabulated {
  Eigen::VectorXd weights;
  std::vector<Eigen::MatrixXd> gradients;

  Tabulated(CellType type, const Eigen::MatrixXd& points, const Eigen::VectorXd& of_points) : weights(of_points) {
    for (const auto& point : points.colwise()) gradients.push_back(shape_gradients(type, point));
  }
  double determinant(std::size_t p, const Eigen::Ref<const Eigen::Matrix3Xd>& x) const {
    return Eigen::Matrix3d(x * gradients[p]).determinant();
  }
};

/// The rule for volumes, and the points at which curved cells are examined.
struct Examined {
  Tabulated volume, points;
};

Tabulated examined_points(CellType type) {
  const Quadrature rule = cell_quadrature(type, 4);
  const Eigen::MatrixXd nodes = local_nodes(type);
  std::vector<int> used;  // the gradients of a pyramid do not exist at its apex
  for (int a = 0; a < nodes.cols(); ++a)
    if (!(vertex_count(type) == 5 && a == 4)) used.push_back(a);
  Eigen::MatrixXd points(3, rule.points.cols() + static_cast<Eigen::Index>(used.size()));
  points << rule.points, nodes(Eigen::all, used);
  return {type, points, Eigen::VectorXd::Zero(points.cols())};
}

const Examined& examined(CellType type) {
  static const std::map<CellType, Examined> of_types = [] {
    std::map<CellType, Examined> all;
    for (const CellInfo& cell : cell_table()) {
      if (cell.dimension != 3) continue;
      const Quadrature rule = cell_quadrature(cell.type, cell.order == 1 ? 3 : 5);
      all.emplace(cell.type, Examined{Tabulated(cell.type, rule.points, rule.weights), examined_points(cell.type)});
    }
    return all;
  }();
  return of_types.at(type);
}

CellType linear_type(CellType type) {
  switch (vertex_count(type)) {
    case 4:
      return CellType::tet4;
    case 5:
      return CellType::pyramid5;
    case 6:
      return CellType::wedge6;
    default:
      return CellType::hex8;
  }
}

}  // namespace

double least_triple_product(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  if (vertex_count(type) == 4) return straight_determinant(x);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [v, n] : corners_of(type))
    least = std::min(least, triple(x.col(n[0]) - x.col(v), x.col(n[1]) - x.col(v), x.col(n[2]) - x.col(v)));
  return least;
}

double cell_volume(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  if (type == CellType::tet4) return straight_determinant(x) / 6;
  if (type == CellType::tet10) return determinant_coefficients(x).mean() / 6;
  const Tabulated& rule = examined(type).volume;
  double volume = 0;
  for (std::size_t p = 0; p < rule.gradients.size(); ++p)
    volume += rule.weights(static_cast<Eigen::Index>(p)) * rule.determinant(p, x);
  return volume;
}

bool may_be_inverted(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x, double share) {
  if (type == CellType::tet10) return determinant_coefficients(x).minCoeff() <= share * straight_determinant(x);
  const Tabulated& points = examined(type).points;
  const Eigen::Matrix3Xd straight = straight_nodes(type, x);
  for (std::size_t p = 0; p < points.gradients.size(); ++p)
    if (points.determinant(p, x) <= share * points.determinant(p, straight)) return true;
  return false;
}

Eigen::Matrix3Xd straight_nodes(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  static const std::map<CellType, Eigen::MatrixXd> shares = [] {
    std::map<CellType, Eigen::MatrixXd> all;
    for (const CellInfo& cell : cell_table()) {
      if (cell.dimension != 3) continue;
      const Eigen::MatrixXd local = local_nodes(cell.type);
      Eigen::MatrixXd of_type(cell.vertices, cell.nodes);
      for (int a = 0; a < cell.nodes; ++a) of_type.col(a) = shape_values(linear_type(cell.type), local.col(a));
      all.emplace(cell.type, of_type);
    }
    return all;
  }();
  return x.leftCols(vertex_count(type)) * shares.at(type);
}

double scaled_jacobian(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  const int vertices = vertex_count(type);
  const double of_regular = vertices == 8 ? 1 : vertices == 6 ? std::sqrt(3.0) / 2 : std::sqrt(0.5);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [v, n] : corners_of(type)) {
    const Eigen::Vector3d a = x.col(n[0]) - x.col(v), b = x.col(n[1]) - x.col(v), c = x.col(n[2]) - x.col(v);
    const double lengths = a.norm() * b.norm() * c.norm();
    least = std::min(least, lengths > 0 ? triple(a, b, c) / lengths / of_regular : 0.0);
  }
  return least;
}

}  // namespace bielle::reduce
