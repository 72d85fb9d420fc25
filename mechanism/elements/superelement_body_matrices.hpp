// The constant matrices of a superelement in the layout of corotated_frame.hpp: three rows per interface displacement
// and (where rotations act) three per rotation, all in body axes, then the modes.
//
// With q_file = P q (P takes the kept directions in the interface's axes), each matrix of the file becomes P^T (.) P:
//     K~, C~, M~,  U (rigid motions), A = M~ U,
//     G_1 = S_32 - S_23, G_2 = S_13 - S_31, G_3 = S_21 - S_12                     (antisymmetric),
//     H_kl = sym(delta_kl sum_j S_jj - S_lk) - K_sigma,kl                         (symmetric),
// so that a body whose frame moves with nu_0 = (v_0, Om_0) (body components) has, s = U nu_0 + qdot,
//     T = s^T M~ s / 2 + s^T G(Om_0) q + q^T H(Om_0) q / 2,   G(Om) = Om_k G_k,   H(Om) = Om_k Om_l H_kl:
// the exact kinetic energy of the reduced displacement field, less the inertia of foreshortening K_sigma (geometric
// stiffness of the free body under the centrifugal field of unit Om_k Om_l; the sum runs over all nine pairs k, l).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/elements/corotated_frame.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

/// Index of the pair (k, l) in the order 11 22 33 23 13 12.
inline constexpr int pair_index(int k, int l) { return k == l ? k : 6 - k - l; }

struct SuperelementMatrices {
  /// A kept direction of the file: q_file = axis . q(row .. row + 2).
  struct Direction {
    int row;
    Vector3 axis;
  };
  /// Column l + 3 k: generalised force of component k of the pattern acting along body axis l.
  using Pattern = Eigen::Matrix<double, Eigen::Dynamic, 9>;

  /// @param reference_rotations  R_ref of each interface's node: node axes -> body axes of the undeformed body
  /// @param reference_positions  where the nodes are in the undeformed body, within the reader's tolerance the file's
  /// @throws InputError when the superelement's arrays do not fit each other or its mass is not positive
  SuperelementMatrices(const Superelement& superelement, const std::vector<Vector3>& reference_positions,
                       const std::vector<Matrix3>& reference_rotations);

  int size() const { return static_cast<int>(K.rows()); }
  int modes = 0;
  double mass = 0;                   ///< [kg] of the displacement field
  Vector3 centre = Vector3::Zero();  ///< of mass, body axes
  std::vector<BodyPoint> points;
  std::vector<Direction> directions;  ///< of the file's interface coordinates

  MatrixX K, C, M;
  MatrixX6 U, A;
  std::array<MatrixX, 3> G;
  std::array<MatrixX6, 3> GU;  ///< G_k U
  std::array<MatrixX, 6> H;
  std::vector<MatrixX> load_stiffness;  ///< per unit force along each direction; empty when the file has none
  std::vector<std::string> pattern_names;
  std::vector<Pattern> patterns;

  /// The file's coordinates of a vector in the present layout.
  void to_file(const Eigen::Ref<const VectorX>& q, Eigen::Ref<VectorX> q_file) const;

 private:
  MatrixX file_rows(int n) const;  // P
};

}  // namespace bielle::mechanism
