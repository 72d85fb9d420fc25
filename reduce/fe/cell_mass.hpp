// Mass matrices of single cells and faces, consistent or lumped. Internal to reduce/fe.
#pragma once

#include <stdexcept>

#include <Eigen/Core>

#include "reduce/dense/blas.hpp"
#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/face_points.hpp"

namespace bielle::reduce {

/// Diagonal that replaces a cell's mass matrix, with its sum: row sums for order 1; for order 2, some of whose row sums
/// are negative, the diagonal of the matrix itself, scaled (E. Hinton, T. Rock, O. C. Zienkiewicz, Earthquake Eng.
/// Struct. Dyn. 4 (1976) 245).
template <class Matrix>
Matrix lumped_mass(const Matrix& mass, bool is_second_order) {
  const double total = mass.sum();
  const Eigen::VectorXd diagonal = is_second_order ? Eigen::VectorXd(mass.diagonal() * (total / mass.trace()))
                                                   : Eigen::VectorXd(mass.rowwise().sum());
  return diagonal.asDiagonal();
}

/// int N_a N_b dV of cells with N nodes [m^3].
template <int N>
class CellMass {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;

  CellMass()
      : rules_(N == 4                          ? CellDegrees{2, 2}
               : SolidCell<N>::is_second_order ? CellDegrees{4, 7}
                                               : CellDegrees{2, 4}),
        straight_(symmetric(products_of(rules_.straight).rowwise().sum())),
        products_(products_of(rules_.curved)),
        gradients_(N, 3 * products_.cols()) {
    if (products_.cols() > most_points) throw std::logic_error("more points in a rule than the mass of cells takes");
    for (Eigen::Index p = 0; p < products_.cols(); ++p)
      gradients_.template middleCols<3>(3 * p) = rules_.curved.local_gradients[static_cast<std::size_t>(p)];
  }

  /// @param least_jacobian  receives the least Jacobian at the points of the rule; the cell is inverted if it is <= 0
  Matrix of(const CellPoints<N>& x, double& least_jacobian) const {
    if (&rules_.of(x) == &rules_.straight) {
      least_jacobian = jacobian_at<N>(rules_.straight, 0, x).determinant();
      return least_jacobian * straight_;
    }
    const Eigen::Index points = products_.cols();
    Eigen::Matrix<double, 3, 3 * most_points> maps;
    maps.leftCols(3 * points).setZero();
    add_dense_product({x.data(), 3, N, 3, false}, {gradients_.data(), N, 3 * points, N, false}, maps.data(), 3);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_points, 1> jacobians(points);
    for (Eigen::Index p = 0; p < points; ++p) jacobians(p) = maps.template middleCols<3>(3 * p).determinant();
    // If a coefficient is NaN, so is the least one, and the cell counts as inverted.
    least_jacobian = jacobians.template minCoeff<Eigen::PropagateNaN>();
    const Pairs pairs = products_ * jacobians;
    return symmetric(pairs);
  }

 private:
  static constexpr int most_points = 125;  // five along each coordinate
  static constexpr int pair_count = N * (N + 1) / 2;
  using Pairs = Eigen::Matrix<double, pair_count, 1>;
  using Products = Eigen::Matrix<double, pair_count, Eigen::Dynamic>;

  /// Weight times N_a N_b of the pairs a >= b (a runs first) at the points of a rule.
  static Products products_of(const CellRule<N>& rule) {
    Products products(pair_count, static_cast<Eigen::Index>(rule.size()));
    for (std::size_t p = 0; p < rule.size(); ++p) {
      const auto point = static_cast<Eigen::Index>(p);
      int pair = 0;
      for (int b = 0; b < N; ++b)
        for (int a = b; a < N; ++a)
          products(pair++, point) = rule.weights(point) * rule.values[p](a) * rule.values[p](b);
    }
    return products;
  }

  static Matrix symmetric(const Pairs& pairs) {
    Matrix result;
    int pair = 0;
    for (int b = 0; b < N; ++b)
      for (int a = b; a < N; ++a) result(a, b) = result(b, a) = pairs(pair++);
    return result;
  }

  CellRules<N> rules_;
  Matrix straight_;                                     // for a Jacobian of 1
  Products products_;                                   // for other cells
  Eigen::Matrix<double, N, Eigen::Dynamic> gradients_;  // local ones at all points of their rule, side by side
};

/// int N_a N_b dA of a face [m^2].
inline Eigen::MatrixXd face_mass(const FacePoints& face) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(face.nodes.size(), face.nodes.size());
  for (Eigen::Index p = 0; p < face.normals.cols(); ++p) {
    const Eigen::VectorXd& values = face.values[static_cast<std::size_t>(p)];
    for (Eigen::Index b = 0; b < sum.cols(); ++b) sum.col(b) += face.normals.col(p).norm() * values(b) * values;
  }
  return sum;
}

}  // namespace bielle::reduce
