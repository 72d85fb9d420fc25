// The force of two shapes on each other: elastic contact forces, damping along the normals, tangential friction.
//
// At each place of contact c, with normal n from the first body to the second and penetration p,
//     F = f_e n + L max(-1, d pdot) n - L max(0, 1 + d pdot) h(|v_t|) v_t    on the second body, -F on the first,
// Here f_e and L are defined in pair_touches.hpp and h in friction_law.hpp, pdot = -n . v, v_t = v - n (n . v), and v
// is the velocity of the second body's material at c relative to the first body's. Everything is computed in the axes
// of the first node, as a function of s = R_1^T (x_2 - x_1), R_12 = R_1^T R_2 and of the rates of both as seen from the
// first node.
// The forces act at one point, equal and opposite: momentum and angular momentum are exactly conserved. The derivatives
// are exact, too. `lugre`: each place in contact has a bristle z, normal to n, which is zero at the beginning of
// contact. In a step in which the second body's material at c has moved by d, seen from the first, and rotated about n
// by psi,
//     z = T P (z_before + d)/(1 + sigma_0 |P d|/mu),   P = I - n n^T,   T = exp(psi/2 n~),
//     F_t = -L max(..) [sigma_0 z + sigma_1 u + sigma_2 v_t],   u = v_t - sigma_0 |v_t| z/mu:
// This is the implicit Euler method, stable for bristles of any stiffness. T rotates the bristle by the mean rotation
// of both bodies: the result does not depend on which of them is the first (exactly if they spin on each other, to the
// order of the method if they roll). d is computed from the positions at both ends of the step, not from rates: a
// sticking contact stays at its place, however it rotates with the pair. The dissipated power is L [sigma_0^2 |v_t|
// z^2/mu + sigma_1 u . v_t + sigma_2 v_t^2] >= 0; the power stored and returned by bristles, L sigma_0 z . u, counts as
// input. If a corner touches a surface at several places, each place takes over the bristle of the nearest earlier
// place on the surface, provided that it is also the nearest place to that one.
//
// A surface whose material moves on its body (a conveyor belt, a turntable) adds the difference u of the two surfaces'
// velocities to v_t; the power of the friction force along u is input of the belts' motors.
// Rolling resistance is a couple -L max(0, 1 + d pdot) b tanh(w/w_0) w_t/w against the part w_t, normal to n, of the
// relative angular velocity, w = |w_t|; b [m] is the arm by which the normal force is displaced.
#pragma once

#include <optional>

#include "mechanism/contacts/pair_touches.hpp"
#include "mechanism/laws/friction_law.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

struct SurfaceLaw {
  NormalLaw normal;
  std::optional<FrictionLaw> friction;
  /// Law `coulomb` with the arm b [m] in place of the coefficient, and w_0 [rad/s] in place of the velocity.
  std::optional<FrictionLaw> rolling;
};

/// The bristle of a place of contact at the end of the last accepted step.
struct Bristle {
  int id = 0;                   ///< Touch::id
  Vector3 z = Vector3::Zero();  ///< deflection in the axes of the first node [m]
  /// Place in the axes of the surface's node; without a surface, in those of the first node.
  Vector3 place = Vector3::Zero();
};

/// The bristles of a pair at the last accepted step, and the position of the second node at that time, seen from the
/// first.
struct Bristles {
  bool known = false;  ///< whether there was an accepted step
  Vector3 s = Vector3::Zero();
  Matrix3 R_12 = Matrix3::Identity();
  std::vector<Bristle> before;
};

class PairForce {
 public:
  /// Both shapes must outlive the object.
  PairForce(const ContactShape& first, const ContactShape& second, const NodeState& first_node,
            const NodeState& second_node);

  /// Forces and energies, without derivatives.
  struct Result {
    Vector12 r = Vector12::Zero();        ///< residual of the two nodes
    Vector3 force = Vector3::Zero();      ///< force on the second body, inertial [N]
    Vector3 place = Vector3::Zero();      ///< place of the deepest contact, inertial [m]
    double depth = 0;                     ///< depth of the deepest contact [m]; 0: they do not touch
    double approach = 0;                  ///< rate of the depth [m/s]
    double elastic = 0, dissipation = 0;  ///< elastic energy [J], dissipation [W]
    double input = 0;                     ///< power returned by bristles [W]
  };
  /// @param damping  d [s/m] @param bristles  for `lugre`; its `before` may be empty
  Result calc(const SurfaceLaw& law, double damping, const Bristles& bristles) const;
  /// Computes the derivatives of the residual by positions, and by rates.
  void calc_tangent(const SurfaceLaw& law, double damping, const Bristles& bristles, Matrix12& K, Matrix12& C) const;
  /// Adds the bristles of the places in contact, for `lugre`; without friction, they are unchanged.
  void add_bristles(const SurfaceLaw& law, const Bristles& bristles, std::vector<Bristle>& now) const;

  /// The place with the smallest gap of the surfaces.
  struct Nearest {
    double gap, rate;  ///< gap [m], its rate [m/s]
    Vector3 place;     ///< place, inertial
    Vector3 normal;    ///< from the first body to the second, inertial
  };
  Nearest nearest() const;

 private:
  Vector3 kept_place(const Vector3& place) const;
  template <class T>
  const std::vector<int>& match(const std::vector<Touch<T>>& touches, const Bristles& bristles) const;
  const ContactShape &first_, &second_;
  const NodeState &node_1_, &node_2_;
  Matrix3 R_12_;
  Vector3 s_, s_rate_, turning_;  ///< turning_: R_12 Omega_2 - Omega_1
};

}  // namespace bielle::mechanism
