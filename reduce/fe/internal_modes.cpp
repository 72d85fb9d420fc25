#include "reduce/fe/internal_modes.hpp"

#include <Eigen/Cholesky>

namespace bielle::reduce {
namespace {

/// Strains by the displacements of the nodes, from the gradients of their shape functions: (6, 3 nodes).
template <int N>
Eigen::Matrix<double, 6, 3 * N> strain_matrix(const Eigen::Matrix<double, N, 3>& gradients) {
  Eigen::Matrix<double, 6, 3 * N> B = Eigen::Matrix<double, 6, 3 * N>::Zero();
  for (int a = 0; a < N; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) B(voigt(i, j), 3 * a + i) += gradients(a, j);
  return B;
}

}  // namespace

/// Returns the gradients of the functions in the reference cell, without their mean: (functions, 3). A factor on a
/// function changes its amplitude alone, and no strain or stiffness.
template <int N>
typename InternalModes<N>::Gradients InternalModes<N>::local_gradients(const Eigen::Vector3d& local) {
  Gradients gradients = Gradients::Zero();
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

template <int N>
typename InternalModes<N>::Modes InternalModes<N>::strains(const Eigen::Vector3d& local, double determinant) const {
  const Gradients gradients = determinant_ / determinant * local_gradients(local) * inverse_;
  Modes G = Modes::Zero();
  for (int k = 0; k < functions; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) G(voigt(i, j), 3 * k + i) += gradients(k, j);
  return G;
}

template <int N>
void InternalModes<N>::set(const CellPoints<N>& x, const Matrix6& elasticity) {
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
    // Coefficient by coefficient, as in map_point.
    const Eigen::Matrix<double, count, 6> stress = volume * G.transpose().lazyProduct(elasticity);
    const Eigen::Matrix<double, 6, 3 * N> B = strain_matrix<N>(gradients);
    K_aa += stress.lazyProduct(G);
    K_au += stress.lazyProduct(B);
  }
  amplitudes_ = -K_aa.ldlt().solve(K_au);
  condensed_ = K_au.transpose().lazyProduct(amplitudes_);
}

template <int N>
typename InternalModes<N>::Strain InternalModes<N>::strain(const Eigen::Matrix<double, N, 3>& gradients,
                                                           const Eigen::Vector3d& local, double determinant) const {
  return strain_matrix<N>(gradients) + strains(local, determinant) * amplitudes_;
}

template class InternalModes<6>;
template class InternalModes<8>;

}  // namespace bielle::reduce
