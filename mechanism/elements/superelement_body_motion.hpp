// Motion and generalised forces of a superelement in its frame: what residual, tangent and energies share.
//
// Velocities and accelerations of the nodes in body axes, w = Q zdot and a = Q zddot - R_0^T g (gravity is an
// acceleration of the frame of reference), Q = diag(R_0^T, R_0^T R_i, I), give with the geometry of corotated_frame.hpp
//     nu_0 = Sigma D w,       w_rel = w - U_c nu_0,                               qdot  = D w_rel,
//     b = D (a + h) + D' w_rel,  h: rows u -Om_0 x (w + w_rel), theta -Om_0 x w,  eta 0,
//     nu_0' = Sigma b,        a_rel = a + h - U_c nu_0',                          qddot = b - V nu_0'.
// Lagrange's equations in quasi-velocities nu_0 = (v_0, Om_0) and q, s = U nu_0 + qdot:
//     p = M~ s + G(Om_0) q,   pi = U^T p + [0; pi_0],   pi_0,k = s.G_k q + Om_l q.H_kl q,
//     r = p' + G(Om_0) s - H(Om_0) q + K~ q + C~ qdot - f,
//     e = pi' + [Om_0 x pi_v; Om_0 x pi_O + v_0 x pi_v] - [U^T f + [0; m]],
// f, m: load patterns. The force on q that both make together, and its image on the nodes' triads, are
//     force = r + Sigma^T (e - V^T r),     node_force = D^T force,     F = Q^T node_force.
#pragma once

#include "mechanism/elements/superelement_body_matrices.hpp"
#include "mechanism/system/state.hpp"

namespace bielle::mechanism {

using Matrix3X = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using MatrixX3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// A load pattern at work.
struct ActingLoad {
  const SuperelementMatrices::Pattern* pattern = nullptr;
  double factor = 0;
  bool follows = true;  ///< turns with the body's frame; else its directions stay fixed in space
};

/// Working memory of one body, kept from one evaluation to the next: no allocation behind the first.
struct SuperelementMotion {
  CorotatedGeometry geometry;
  VectorX w, w_rel, a, a_rel;  ///< node triads in body axes
  Vector6 nu, nu_rate;         ///< nu_0 and nu_0'
  VectorX q_rate, q_acceleration, s, s_rate;
  MatrixX3 Gq, Gs, Gq_rate;  ///< columns k: G_k q, ...
  MatrixX6 Hq;               ///< columns: H_kl q
  VectorX p, p_rate;
  Vector6 pi, pi_rate, e;
  VectorX r, load, elastic_force, force, node_force;
  MatrixX stiffness;   ///< K~ + F_j K_load,j
  Vector6 rigid_load;  ///< U^T f + [0; m]
  std::vector<ActingLoad> loads;

  /// Solves for the frame and computes the motion. @throws ComputationError
  void set_motion(const CorotatedFrame& frame, const LocalState& state);
  /// Computes the forces of the motion. `loads` must be set.
  /// @param interface_force  per direction, weights of the load stiffness; ignored when the body has none
  void set_forces(const SuperelementMatrices& body, const Eigen::Ref<const VectorX>& interface_force);

  double kinetic_energy(const SuperelementMatrices& body) const;  ///< set_forces must have been called

 private:
  void set_stiffness(const SuperelementMatrices& body, const Eigen::Ref<const VectorX>& interface_force);
  VectorX weights_;  // F_j in `stiffness`: they change once in a step, the stiffness serves all its evaluations
};

/// Direction of component k of a load in body axes.
Vector3 load_direction(const ActingLoad& load, const Matrix3& R_0, int k);

}  // namespace bielle::mechanism
