// The exact tangent of a superelement; used by superelement_body.cpp alone.
//
// Increments dz^ of the node triads (body axes) move the frame by dnu = Sigma D dz^ and the nodes relative to it by
// delta = dz^ - U_c dnu; dphi_0 is the rotation in dnu, L = [Sigma; I - V Sigma]. What changes in F = Q^T D^T force is
//   the map:      K^ = -[F^] dphi_0 + diag(0, F^_theta~) + Z delta - B_0^T Y delta,    F^ = D^T force,
//                 Z: theta blocks d(D^T force)/dphi,  Y: u blocks -F^_u~, theta blocks those of Z,  B_0: rotation rows
//                 of Sigma D;
//   the forces:   D^T L^T [de; dr] = D^T (KQ dq + CQ (rates) + MQ (accelerations)),
//                 KQ = L^T d(e; r)/dq,  CQ = L^T d(e; r)/d(nu_0, qdot) L,  MQ = L^T d(e; r)/d(nu_0', qddot) L.
// Rates and accelerations change with positions and with velocities by a block on each triad and six columns on dnu:
//   d(nu_0, qdot)   = L (A_v dz^ + B_v dnu)                                     | L D dw^
//   d(nu_0', qddot) = L (A_a dz^ + B_a dnu + H_0 Sigma (A_v dz^ + B_v dnu))     | L (H_w + H_0 Sigma D) dw^.
// Hence
//   K = Q^T [K^ + D^T (KQ (I - V Sigma) D + CQ (A_v + B_v Sigma D)
//                      + MQ (A_a + B_a Sigma D + H_0 Sigma (A_v + B_v Sigma D)))] Q,
//   C = Q^T  D^T [CQ D + MQ (H_w + H_0 Sigma D)]  Q,
//   M = Q^T  D^T MQ D  Q.
// Every dense product has six columns or a block-diagonal factor: O(n^2) operations.
#pragma once

#include "mechanism/elements/superelement_body_motion.hpp"
#include "mechanism/system/component.hpp"

namespace bielle::mechanism {

/// Computes the tangent of one evaluation. Working memory, kept like SuperelementMotion.
class SuperelementTangent {
 public:
  /// @param motion  with its forces set
  void add(const SuperelementMatrices& body, const SuperelementMotion& motion, const LocalState& state,
           LocalTangent& tangent);

 private:
  struct RotationBlocks {
    Matrix3 D, A_v, A_a, H_w, Z;
  };
  struct View;  // what the functions below share
  void set_rate_blocks(const View& v);
  void set_mass_form(const View& v);
  void set_rate_form(const View& v);
  void set_position_form(const View& v);
  void add_load_turning(const View& v);
  void add_map_change(const View& v);
  void reduce_both_sides(const View& v, const Matrix6& X_nn, const Matrix6X& X_nq, const MatrixX6& X_qn, MatrixX& X_qq);
  void multiply_by_D(const View& v, const MatrixX& X);
  void add_blocks(const View& v, const MatrixX& X, const Matrix3& u_block, Matrix3 RotationBlocks::*theta_block);
  void multiply_by_D_transposed(const View& v);
  void add_to(const View& v, Eigen::Ref<MatrixX> target);

  std::vector<RotationBlocks> rotation_;
  Matrix3 A_v_u_, A_a_u_, H_w_u_;  // blocks of every displacement triad
  MatrixX6 B_v_, B_a_, H_0_;
  Matrix6X Sigma_D_, Sigma_A_v_;
  Matrix6 M_nn_;   // d pi / d nu_0
  Matrix6X M_nq_;  // d pi / d qdot
  MatrixX MQ_, CQ_, KQ_, result_;
  MatrixX6 six_, left_;
  Matrix6X rows_, more_rows_;
  MatrixX3 three_, Gs_rate_;
  MatrixX6 Hq_rate_;
  Matrix3X Y_;
};

}  // namespace bielle::mechanism
