// The exact tangent of a superelement; for superelement_body.cpp only.
//
// Increments dz^ of the node triads (body axes) move the frame by dnu = Sigma D dz^ and the nodes relative to it by
// delta = dz^ - U_c dnu; dphi_0 is the rotation in dnu, L = [Sigma; I - V Sigma]. The changes in F = Q^T D^T force are
//   the map:      K^ = -[F^] dphi_0 + diag(0, F^_theta~) + Z delta - B_0^T Y delta,    F^ = D^T force,
//                 Z: theta blocks d(D^T force)/dphi,  Y: u blocks -F^_u~, theta blocks those of Z,  B_0: rotation rows
//                 of Sigma D;
//   the forces:   D^T L^T [de; J^T (dr + phi_r K_r deps)] = D^T (KQ dq + CQ (rates) + MQ (accelerations)); with the
//   forms
//                 X of e and r in (nu_0, eps), their rates or accelerations, L^T [X_nn, X_nq J; J^T X_qn, J^T X_qq J]
//                 L. Since J itself changes, dJ qdot = J G(epsdot) deps, with a similar term for accelerations, CQ also
//                 has 2 X_M J G(epsdot), KQ also X_C J G(epsdot) + X_M J G(eps'') (in columns of eps).
// Rates and accelerations change with positions and with velocities by a block on each triad and six columns on dnu:
//   d(nu_0, qdot)   = L (A_v dz^ + B_v dnu)                                     | L D dw^
//   d(nu_0', qddot) = L (A_a dz^ + B_a dnu + H_0 Sigma (A_v dz^ + B_v dnu))     | L (H_w + H_0 Sigma D) dw^.
// Therefore
//   K = Q^T [K^ + D^T (KQ (I - V Sigma) D + CQ (A_v + B_v Sigma D)
//                      + MQ (A_a + B_a Sigma D + H_0 Sigma (A_v + B_v Sigma D)))] Q,
//   C = Q^T  D^T [CQ D + MQ (H_w + H_0 Sigma D)]  Q,
//   M = Q^T  D^T MQ D  Q.
// Every dense product has a factor with six columns, one that is block-diagonal or, for J and G, one with as many rows
// as the interfaces have: O(n^2) operations for a given number of interfaces.
#pragma once

#include "mechanism/elements/superelement/attached_point.hpp"
#include "mechanism/elements/superelement/superelement_body_motion.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Computes the tangent of one evaluation. The working memory is kept like SuperelementMotion.
class SuperelementTangent {
 public:
  /// @param damping  C~
  /// @param motion   motion with its forces set; only its products are required if the tangent requests M alone
  void add(const SuperelementMatrices& body, const MatrixX& damping, SuperelementMotion& motion,
           const LocalState& state, const std::vector<AttachedPoint>& points, LocalTangent& tangent);

 private:
  struct RotationBlocks {
    Matrix3 D, A_v, A_a, H_w, Z;
  };
  struct View;  // arguments of the functions below
  void set_rotation_blocks(const View& v);
  void set_rate_blocks(const View& v);
  void set_products(const View& v);
  void set_mass_form(const View& v);
  void add_spin_to_mass_form(const View& v);
  void add_spin_to_rate_form(const View& v, Matrix6& X_nn);
  void add_spin_to_position_form(const View& v);
  void set_coordinate_changes(const View& v);
  void set_rate_form(const View& v);
  void add_rate_changes(const View& v);
  void set_position_form(const View& v);
  void add_stiffnesses(const View& v);
  void add_momentum_changes(const View& v);
  void add_load_turning(const View& v);
  void add_map_change(const View& v);
  void multiply_by_J(const View& v, Matrix6X& X);
  void multiply_by_J_transposed(const View& v, MatrixX6& X);
  void multiply_by_J_both_sides(const View& v, MatrixX& X);
  void reduce_both_sides(const View& v, const Matrix6& X_nn, const Matrix6X& X_nq, const MatrixX6& X_qn, MatrixX& X_qq);
  void multiply_by_D(const View& v, const MatrixX& X);
  void add_blocks(const View& v, const MatrixX& X, const Matrix3& u_block, Matrix3 RotationBlocks::*theta_block);
  void multiply_by_D_transposed(const View& v);
  void add_points(const View& v, const std::vector<AttachedPoint>& points, Eigen::Ref<MatrixX> target);
  void set_local_columns(const View& v, const Matrix6X& X, Matrix6X& local);
  void add_to(const View& v, Eigen::Ref<MatrixX> target);

  std::vector<RotationBlocks> rotation_;
  Matrix3 A_v_u_, A_a_u_, H_w_u_;  // blocks of every displacement triad
  MatrixX6 B_v_, B_a_, H_0_;
  Matrix6X Sigma_D_, Sigma_A_v_;
  Matrix6 M_nn_;                               // d pi / d nu_0
  Matrix6X M_nq_;                              // d pi / d epsdot
  Matrix6X K_nq_;                              // d e / d eps
  MatrixX rate_change_, acceleration_change_;  // nonzero rows of J G(epsdot), J G(eps'')
  PrestressGradient gradient_;                 // G(epsdot)^T, then G(eps'')^T
  Matrix6X six_left_, point_rows_, frame_motion_, node_motion_, shape_motion_;
  MatrixX6 six_top_;
  MatrixX3 three_top_;
  MatrixX interface_rows_, interface_columns_;
  MatrixX M_qq_;  // d p / d epsdot
  MatrixX MQ_, CQ_, KQ_, result_;
  MatrixX6 six_, left_;
  Matrix6X rows_, more_rows_;
  VectorX s_rate_;
  MatrixX3 three_, Gs_, Gs_rate_, Geps_rate_;  // columns: G_k s, G_k s', G_k epsdot
  MatrixX3 spin_force_;                        // column k: Om_m,l K_sigma,kl eps
  MatrixX6 Heps_rate_;
  Matrix3X Y_, turning_;
};

}  // namespace bielle::mechanism
