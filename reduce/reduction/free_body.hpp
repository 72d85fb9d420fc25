// The free body under loads that its own inertia balances, and the geometric stiffness of the resulting stress.
//
// Spin: the acceleration field per unit Om_k Om_l, symmetric in k and l, of a body that turns freely about its centre
// c,
//     a_kl = [e_k x (e_l x r) + e_l x (e_k x r)] / 2 + w_kl x r,   J w_kl = -[e_k x J e_l + e_l x J e_k] / 2,
// r = x - c, so that the load -rho a_kl is self-equilibrated (Euler's equations; sum over k, l of Om_k Om_l a_kl is the
// acceleration at the angular velocity Om). Load: a unit force or moment on a direction of an interface, with -rho a, a
// = F / m + w x r, J w = M + (X - c) x F. The displacement u0 of the free body follows from the held one: u0 = Psi q +
// u_held with K~_bb q = f + Psi^T f_i, solved in the complement of the rigid motions. With clamped interfaces reactions
// would count twice.
//
// The geometric stiffness of the stress sigma of u0 is T^T (g (x) I3) T, g_ab = int grad N_a . sigma grad N_b dV, plus
// the second-order displacements of tied surfaces, see tie_second_order.hpp. With these terms the energy is that of an
// interface that turns through finite angles: for a rigid rotation theta about c it is (theta^T [tr(Q) I - sym(Q)]
// theta) / 2, Q = sum F (X - c)^T - int rho a r^T dV, independent of stresses; this identity is one of the stored
// checks. (It holds at second order only; in the moment's work theta is the rotation vector.)
#pragma once

#include <array>
#include <vector>

#include "reduce/reduction/basis.hpp"

namespace bielle::reduce {

struct GeometricStiffness {
  std::array<Eigen::MatrixXd, 6> spin;  ///< per unit Om_k Om_l: 11 22 33 23 13 12 [K~ s^2]
  std::vector<Eigen::MatrixXd> load;    ///< per unit load of each kept direction [K~/N, K~/(N m)]
  RowMatrix load_fields;  ///< (3 points, directions) displacement of the free body under each of these loads
  std::vector<Eigen::MatrixXd> rotations;  ///< rotations of each interface's surface, body axes (3,n); zero for free
                                           ///< ties
};

/// Q of the file comment for each spin field, then for each kept direction, as needed in `theta^T [tr(Q) I - sym(Q)]
/// theta`.
std::vector<Eigen::Matrix3d> virials(const std::vector<Interface>& interfaces, const MassProperties& body);

/// @param reduced_stiffness  K~ (n,n)
/// @param with_loads         false: spins only
GeometricStiffness geometric_stiffness(const Solid& solid, const BodyMatrices& matrices, const Ties& ties,
                                       const Basis& basis, const MassProperties& body,
                                       const Eigen::MatrixXd& reduced_stiffness, bool with_loads, Progress& progress);

}  // namespace bielle::reduce
