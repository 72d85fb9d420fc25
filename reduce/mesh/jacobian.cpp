#include "reduce/mesh/jacobian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

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

double scaled_jacobian(const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
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

}  // namespace bielle::reduce
