// Matrices of the reduced body: K~ = T^T K T, the inertia components S_kl = T_k^T m T_l, C~ of modal or Rayleigh
// damping, and the free body's modes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reduce/reduction/basis.hpp"

namespace bielle::reduce {

/// T^T Y for two blocks of vectors, symmetric or not.
Eigen::MatrixXd inner_products(const RowMatrix& a, const RowMatrix& b);

/// S_11 S_22 S_33 S_23 S_13 S_12, T_k the rows of T of component k.
std::array<Eigen::MatrixXd, 6> inertia_components(const RowMatrix& shapes, const BodyMatrices& matrices);

/// Modes of a free reduced body. Rigid motions are separated exactly, so that the elastic modes contain none of them.
struct FreeModes {
  Eigen::VectorXd omega;    ///< frequencies of the elastic modes, ascending [rad/s]
  Eigen::MatrixXd vectors;  ///< (n, elastic modes), V^T M~ V = I
};

/// @param rigid  U (n,6)
/// @throws ComputationError when the reduced mass matrix is not positive definite
FreeModes free_modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& rigid);

/// C~ = sum over elastic modes of 2 zeta omega (M~ v)(M~ v)^T: each mode has its damping ratio, and rigid motions are
/// not damped.
/// @param ratios  zeta of the first, second ... elastic mode; the last holds for all further ones; empty means no
/// damping
/// @throws InputError when there are more ratios than elastic modes
Eigen::MatrixXd modal_damping(const FreeModes& modes, const Eigen::MatrixXd& mass, const std::vector<double>& ratios);

}  // namespace bielle::reduce
