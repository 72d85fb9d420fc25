// Motion and generalised forces of a superelement in its frame: common part of residual, tangent and energies.
//
// Velocities and accelerations of the nodes in body axes, w = Q zdot and a = Q zddot - R_0^T g (gravity is an
// acceleration of the frame of reference), Q = diag(R_0^T, R_0^T R_i, I), give with the geometry of corotated_frame.hpp
//     nu_0 = Sigma D w,       w_rel = w - U_c nu_0,                               qdot  = D w_rel,
//     b = D (a + h) + D' w_rel,  h: rows u -Om_0 x (w + w_rel), theta -Om_0 x w,  eta 0,
//     nu_0' = Sigma b,        a_rel = a + h - U_c nu_0',                          qddot = b - V nu_0'.
// The body's linear coordinates follow from linear_coordinates.hpp: epsdot = J qdot, eps'' = J (qddot + G(epsdot)
// epsdot). Lagrange's equations in quasi-velocities nu_0 = (v_0, Om_0) and eps, with s = U nu_0 + epsdot, Om_m = Lambda
// s, kappa_kl = eps.K_sigma,kl eps, are
//     p = M~ s + G(Om_0) eps - Lambda^T kappa Om_m,
//     pi = U^T p + [0; pi_0],   pi_0,k = s.G_k eps + Om_l eps.H_kl eps,
//     r = p' + G(Om_0) s - H(Om_0) eps + K_sigma(Om_m) eps + K~ eps + C~ epsdot - f,
//     e = pi' + [Om_0 x pi_v; Om_0 x pi_O + v_0 x pi_v] - [U^T f + [0; m]],
// with the load patterns f, m. With phi = J^T r, the total force on q, and its image on the nodes' triads, are
//     force = phi + Sigma^T (e - V^T phi),     node_force = D^T force,     F = Q^T node_force.
#pragma once

#include "mechanism/elements/superelement/corotated_frame.hpp"
#include "mechanism/elements/superelement/linear_coordinates.hpp"
#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

using Matrix3X = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using MatrixX3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// An active load pattern.
struct ActingLoad {
  const SuperelementMatrices::Pattern* pattern = nullptr;
  double factor = 0;
  bool follows = true;  ///< whether directions rotate with the body's frame; otherwise they are fixed in space
};

/// Working memory of one body, kept from one evaluation to the next, so that only the first one allocates memory.
struct SuperelementMotion {
  using Columns = Eigen::Map<const MatrixX>;

  CorotatedGeometry geometry;
  LinearCoordinates coordinates;
  VectorX w, w_rel, a, a_rel;  ///< node triads in body axes
  Vector6 nu, nu_rate;         ///< nu_0 and nu_0'
  VectorX eps_rate, eps_acceleration, s;
  Vector3 Om_mean, Om_mean_rate;  ///< Om_m and its rate
  Matrix3 kappa, kappa_rate;
  Vector6 pi, pi_rate, e;
  VectorX r, load, phi, force, node_force;
  Vector6 rigid_load;  ///< U^T f + [0; m]
  std::vector<ActingLoad> loads;
  VectorX attached_force;   ///< force on eps due to nodes attached to points (n); empty: no node is attached
  Vector6 attached_wrench;  ///< their force on the frame

  /// Solves for the frame and the linear coordinates. @throws ComputationError
  void set_positions(const SuperelementMatrices& body, const CorotatedFrame& frame, const LocalState& state);
  /// Computes nu_0, w, epsdot and s, after set_positions.
  void set_velocities(const SuperelementMatrices& body, const CorotatedFrame& frame, const LocalState& state);
  /// Computes nu_0', a and eps'', after set_velocities.
  void set_accelerations(const SuperelementMatrices& body, const CorotatedFrame& frame, const LocalState& state);
  /// Computes the products of the body's matrices with eps, after set_positions.
  void set_products(const SuperelementMatrices& body);
  /// Computes the forces of the load patterns, after set_positions. `loads` must be set.
  void set_loads(const SuperelementMatrices& body);
  /// Computes Om_m, after set_velocities and set_products.
  void set_mean_turning(const SuperelementMatrices& body);
  /// Computes the forces of the motion, after all of the functions above.
  /// @param damping  C~
  void set_forces(const SuperelementMatrices& body, const MatrixX& damping);

  // Products of the matrices with eps: columns K eps; H_kl eps; K_sigma,kl eps; G_k eps.
  Columns elastic_force() const { return columns(0, 1); }
  Columns Heps() const { return columns(1, 6); }
  Columns spin_eps() const { return columns(7, 6); }  ///< only if the body is stiffened by spin
  Columns Geps() const { return columns(products.cols() - 3, 3); }

  double elastic_energy() const { return 0.5 * eps_forms[0]; }  ///< [J], after set_products
  double kinetic_energy(const SuperelementMatrices& body);      ///< [J], after set_mean_turning

  double dissipation(const MatrixX& damping);  ///< epsdot.C~ epsdot [W], after set_velocities

  MatrixX products;                   ///< the columns above (n, 10 or 16)
  VectorX eps_forms;                  ///< eps times each of them
  Eigen::Matrix<double, 6, 3> UGeps;  ///< columns: U^T G_k eps

 private:
  Columns columns(Eigen::Index first, Eigen::Index count) const {
    return {products.data() + first * products.rows(), products.rows(), count};
  }
  void set_momentum(const SuperelementMatrices& body);    ///< pi and its rate
  void set_node_force(const SuperelementMatrices& body);  ///< phi, force, node_force from r and e

  VectorX rate_forms_;                                  ///< epsdot times each column of `products`
  Eigen::Matrix<double, 27, 1> rates_of_rigid_;         ///< epsdot times each of the body's `rigid_columns`
  Eigen::Matrix<double, 9, 1> accelerations_of_rigid_;  ///< eps'' times the first nine of them
  VectorX four_, weights_, entries_;                    ///< buffers
};

/// Returns the direction of component k of a load in body axes.
Vector3 load_direction(const ActingLoad& load, const Matrix3& R_0, int k);

}  // namespace bielle::mechanism
