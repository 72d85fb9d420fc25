// Mass matrices of single cells and faces, consistent or lumped. Internal to reduce/fe.
#pragma once

#include <Eigen/Core>

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
        straight_(integrate(rules_.straight, [](std::size_t) { return 1.0; })) {}

  /// @param least_jacobian  receives the least Jacobian at the points of the rule; the cell is inverted if it is <= 0
  Matrix of(const CellPoints<N>& x, double& least_jacobian) const {
    const CellRule<N>& rule = rules_.of(x);
    const auto jacobian = [&](std::size_t p) { return Eigen::Matrix3d(x * rule.local_gradients[p]).determinant(); };
    least_jacobian = jacobian(0);
    if (&rule == &rules_.straight) return jacobian(0) * straight_;
    return integrate(rule, [&](std::size_t p) {
      const double value = jacobian(p);
      if (!(value >= least_jacobian)) least_jacobian = value;
      return value;
    });
  }

 private:
  template <class Jacobian>
  static Matrix integrate(const CellRule<N>& rule, const Jacobian& jacobian) {
    Matrix sum = Matrix::Zero();
    for (std::size_t p = 0; p < rule.size(); ++p) {
      sum.noalias() += rule.weights(p) * jacobian(p) * rule.values[p] * rule.values[p].transpose();
    }
    return sum;
  }

  CellRules<N> rules_;
  Matrix straight_;  // for a Jacobian of 1
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
