// Conversion between tensors and their six components in the order xx yy zz yz xz xy.
#pragma once

#include <array>

#include <Eigen/Core>

namespace bielle::reduce {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Index of component ij in the order xx yy zz yz xz xy.
constexpr int voigt(int i, int j) { return i == j ? i : 6 - i - j; }

/// The components in that order: 11 22 33 23 13 12, counted from 0.
inline constexpr std::array<std::array<int, 2>, 6> voigt_pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Engineering strain of the displacement gradient du_i/dx_j.
inline Vector6 strain_of(const Eigen::Matrix3d& h) {
  return {h(0, 0), h(1, 1), h(2, 2), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0), h(0, 1) + h(1, 0)};
}

/// Symmetric tensor of six stress components.
inline Eigen::Matrix3d tensor_of(const Vector6& s) {
  return (Eigen::Matrix3d() << s(0), s(5), s(4), s(5), s(1), s(3), s(4), s(3), s(2)).finished();
}

/// C_ijkl in row i + 3 k, column j + 3 l, which maps int dN_a/dx_j dN_b/dx_l to the stiffness block K_ab,ik.
inline Eigen::Matrix<double, 9, 9> elasticity_tensor(const Eigen::Matrix<double, 6, 6>& c) {
  Eigen::Matrix<double, 9, 9> tensor;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) {
          tensor(i + 3 * k, j + 3 * l) = c(voigt(i, j), voigt(k, l));
        }
      }
    }
  }
  return tensor;
}

/// Q with Q s the components of a stress in turned axes: s'_ij = R_im R_jn s_mn.
/// @param rotation  R, from the axes of s to those of the result
inline Eigen::Matrix<double, 6, 6> stress_rotation(const Eigen::Matrix3d& rotation) {
  Eigen::Matrix<double, 6, 6> turn;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      const auto [i, j] = voigt_pairs[static_cast<std::size_t>(a)];
      const auto [m, n] = voigt_pairs[static_cast<std::size_t>(b)];
      turn(a, b) = rotation(i, m) * rotation(j, n);
      if (m != n) turn(a, b) += rotation(i, n) * rotation(j, m);
    }
  return turn;
}

/// Rotates elastic constants: C'_ijkl = R_im R_jn R_ko R_lp C_mnop.
/// @param elasticity  C in the material's axes, order xx yy zz yz xz xy [Pa]
/// @param rotation    R, material -> body: its columns are the material's axes
inline Eigen::Matrix<double, 6, 6> rotate_elasticity(const Eigen::Matrix<double, 6, 6>& elasticity,
                                                     const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix<double, 6, 6> turn = stress_rotation(rotation);
  const Eigen::Matrix<double, 6, 6> turned = turn * elasticity * turn.transpose();
  return 0.5 * (turned + turned.transpose());
}

}  // namespace bielle::reduce
