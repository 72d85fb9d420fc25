// Internal displacement modes of cells of order 1, without which they would lock in bending. Internal to reduce/fe.
//
// hex8 has the modes 1 - xi_k^2 along each coordinate, wedge6 that along its height and the products l_a l_b of its
// triangle, in three directions each. (They cannot mend the constant strain of the triangle itself: wedge6 stays stiff
// in bending within the plane of its triangles.) They belong to the cell alone and are condensed: their amplitudes
// follow from the displacements u of the nodes,
//     alpha = -K_aa^-1 K_au u,   strain = (B - G K_aa^-1 K_au) u.
// The strains G of the modes are made from local gradients without mean, with the Jacobian J_0 in the middle of the
// cell and the factor det J_0 / det J: their integral vanishes, and the patch test is passed on any mesh. Reference: R.
// L. Taylor, P. J. Beresford, E. L. Wilson, A non-conforming element for stress analysis, Int. J. Numer. Meth. Engng 10
// (1976) 1211-1219.
#pragma once

#include <array>

#include <Eigen/Cholesky>

#include "reduce/fe/cell_fields.hpp"
#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/elasticity.hpp"

namespace bielle::reduce {

/// Strains by the displacements of the nodes, from the gradients of their shape functions: (6, 3 nodes).
template <int N>
Eigen::Matrix<double, 6, 3 * N> strain_matrix(const Eigen::Matrix<double, N, 3>& gradients) {
  Eigen::Matrix<double, 6, 3 * N> B = Eigen::Matrix<double, 6, 3 * N>::Zero();
  for (int a = 0; a < N; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) B(voigt(i, j), 3 * a + i) += gradients(a, j);
  return B;
}

template <int N>
class InternalModes {
 public:
  static constexpr int functions = N == 8 ? 3 : N == 6 ? 4 : 0;
  static constexpr bool any = functions > 0;
  static constexpr int count = 3 * functions;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Strain = Eigen::Matrix<double, 6, 3 * N>;

  explicit InternalModes(Integration integration)
      : active_(any && integration != Integration::plain),
        rule_(cell_quadrature(SolidCell<N>::type, stiffness_degrees<N>().curved)),
        middle_(shape_gradients(SolidCell<N>::type,
                                N == 6 ? Eigen::Vector3d(1.0 / 3, 1.0 / 3, 0) : Eigen::Vector3d(0, 0, 0))) {}

  bool active() const { return active_; }

  /// Condenses the modes of a cell that is nowhere inverted.
  void set(const CellPoints<N>& x, const Matrix6& elasticity) {
    const Eigen::Matrix3d jacobian = x * middle_;
    inverse_ = jacobian.inverse();
    determinant_ = jacobian.determinant();
    Eigen::Matrix<double, count, count> K_aa = Eigen::Matrix<double, count, count>::Zero();
    Eigen::Matrix<double, count, 3 * N> K_au = Eigen::Matrix<double, count, 3 * N>::Zero();
    Eigen::Matrix<double, N, 3> gradients;
    for (std::size_t p = 0; p < rule_.size(); ++p) {
      const double volume = map_point<N>(rule_, p, x, gradients);
      const Modes G =
          strains(rule_.points.col(static_cast<Eigen::Index>(p)), volume / rule_.weights(static_cast<Eigen::Index>(p)));
      const Eigen::Matrix<double, count, 6> stress = volume * G.transpose() * elasticity;
      K_aa += stress * G;
      K_au += stress * strain_matrix<N>(gradients);
    }
    amplitudes_ = -K_aa.ldlt().solve(K_au);
    condensed_.noalias() = K_au.transpose() * amplitudes_;
  }

  /// K_ua times the amplitudes by displacements: added to the stiffness of the displacements alone, (3 N, 3 N).
  const Eigen::Matrix<double, 3 * N, 3 * N>& condensed() const { return condensed_; }

  /// Strain at a point, with the modes. @param local  the point in the reference cell
  /// @param determinant  determinant of the Jacobian there
  Strain strain(const Eigen::Matrix<double, N, 3>& gradients, const Eigen::Vector3d& local, double determinant) const {
    return strain_matrix<N>(gradients) + strains(local, determinant) * amplitudes_;
  }

 private:
  using Modes = Eigen::Matrix<double, 6, count>;

  /// Gradients of the functions in the reference cell, without their mean: (functions, 3).
  static Eigen::Matrix<double, functions, 3> local_gradients(const Eigen::Vector3d& local) {
    Eigen::Matrix<double, functions, 3> gradients = Eigen::Matrix<double, functions, 3>::Zero();
    if constexpr (N == 8) {
      gradients.diagonal() = -2 * local;
    } else if constexpr (N == 6) {
      gradients(0, 2) = -2 * local(2);
      const Eigen::Vector2d x = local.head<2>().array() - 1.0 / 3;  // from the middle of the triangle
      gradients.row(1) << -2 * x(0) - x(1), -x(0), 0;               // l_0 l_1
      gradients.row(2) << x(1), x(0), 0;                            // l_1 l_2
      gradients.row(3) << -x(1), -x(0) - 2 * x(1), 0;               // l_2 l_0
    }
    return gradients;
  }

  Modes strains(const Eigen::Vector3d& local, double determinant) const {
    const Eigen::Matrix<double, functions, 3> gradients =
        determinant_ / determinant * local_gradients(local) * inverse_;
    Modes G = Modes::Zero();
    for (int k = 0; k < functions; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) G(voigt(i, j), 3 * k + i) += gradients(k, j);
    return G;
  }

  bool active_;
  CellRule<N> rule_;
  Eigen::Matrix<double, N, 3> middle_;
  Eigen::Matrix3d inverse_;
  double determinant_ = 0;
  Eigen::Matrix<double, count, 3 * N> amplitudes_;
  Eigen::Matrix<double, 3 * N, 3 * N> condensed_;
};

/// Sets A eps at all points of a rule in a cell, with its internal modes if they are active. @param A_of  (volume of
/// the point) -> (6, 6)
/// @param visit  (point, gradients, volume), called before
template <int N, class Matrices, class Visit>
void set_strains(CellFields<N>& cell, InternalModes<N>& modes, const CellRule<N>& rule, const CellPoints<N>& x,
                 const Eigen::Matrix<double, 6, 6>& elasticity, const Matrices& A_of, const Visit& visit) {
  Eigen::Matrix<double, N, 3> gradients;
  if constexpr (InternalModes<N>::any)
    if (modes.active()) modes.set(x, elasticity);
  for (std::size_t p = 0; p < rule.size(); ++p) {
    const auto point = static_cast<Eigen::Index>(p);
    const double volume = map_point<N>(rule, p, x, gradients);
    visit(point, gradients, volume);
    if constexpr (InternalModes<N>::any)
      if (modes.active()) {
        cell.set_strain(point, A_of(volume),
                        modes.strain(gradients, rule.points.col(point), volume / rule.weights(point)));
        continue;
      }
    cell.set_point(point, A_of(volume), gradients);
  }
}

}  // namespace bielle::reduce
