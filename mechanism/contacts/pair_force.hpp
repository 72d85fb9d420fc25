// The force of two shapes on each other: elastic forces where they press, damping along the normals, friction across.
//
// At each place of contact c, normal n from the first body to the second, depth p,
//     F = f_e n + L max(-1, d pdot) n - L max(0, 1 + d pdot) h(|v_t|) v_t    on the second body, -F on the first,
// f_e and L of pair_touches.hpp, pdot = -n . v and v_t = v - n (n . v), v the velocity of the second body's material at
// c relative to the first body's. h of friction_law.hpp. Everything is computed in the axes of the first node, where it
// is a function of s = R_1^T (x_2 - x_1), R_12 = R_1^T R_2 and of the rates of both as the first node sees them.
// Forces at one place, equal and opposite: momentum and angular momentum are exact. Derivatives are exact, too.
// `lugre`: each place that presses has a bristle z, zero where it begins to touch, across the normal. Over a step in
// which the second body's material at c has moved by d, seen from the first, and turned about n by psi,
//     z = T P (z_before + d)/(1 + sigma_0 |P d|/mu),   P = I - n n^T,   T = exp(psi/2 n~),
//     F_t = -L max(..) [sigma_0 z + sigma_1 u + sigma_2 v_t],   u = v_t - sigma_0 |v_t| z/mu:
// the implicit Euler method, stable for bristles of any stiffness. T carries it by the mean of both bodies: which of
// them is the first does not matter (exactly so where they spin on each other, to the order of the method where they
// roll). d is found from the positions at both ends of the step, not from rates: what sticks stays at its place,
// however it turns with the pair. What is lost is L [sigma_0^2 |v_t| z^2/mu + sigma_1 u . v_t + sigma_2 v_t^2] >= 0;
// what bristles take and give back, L sigma_0 z . u, counts as input. Where a corner touches a surface in several
// places, a place has the bristle of the place before that is nearest to it on the surface, if it is also the nearest
// to that one.
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
};

/// The bristle of a place of contact, as the last accepted step has left it.
struct Bristle {
  int id = 0;                       ///< Touch::id
  Vector3 z = Vector3::Zero();      ///< in the axes of the first node [m]
  Vector3 place = Vector3::Zero();  ///< as the node of the surface of triangles sees it; without one, the first node
};

/// Of a pair: its bristles of the last accepted step, and where the second node was then, seen from the first.
struct Bristles {
  bool known = false;  ///< there was such a step
  Vector3 s = Vector3::Zero();
  Matrix3 R_12 = Matrix3::Identity();
  std::vector<Bristle> before;
};

class PairForce {
 public:
  /// Both must outlive it.
  PairForce(const ContactShape& first, const ContactShape& second, const NodeState& first_node,
            const NodeState& second_node);

  /// What acts, without derivatives.
  struct Result {
    Vector12 r = Vector12::Zero();        ///< residual of the two nodes
    Vector3 force = Vector3::Zero();      ///< on the second body, inertial [N]
    Vector3 place = Vector3::Zero();      ///< of the deepest contact, inertial [m]
    double depth = 0;                     ///< of the deepest contact [m]; 0: they do not touch
    double approach = 0;                  ///< its rate [m/s]
    double elastic = 0, dissipation = 0;  ///< [J], [W]
    double input = 0;                     ///< what bristles give back [W]
  };
  /// @param damping  d [s/m] @param bristles  of `lugre`; its `before` may be empty
  Result calc(const SurfaceLaw& law, double damping, const Bristles& bristles) const;
  /// Derivatives of the residual by positions, and by rates.
  void calc_tangent(const SurfaceLaw& law, double damping, const Bristles& bristles, Matrix12& K, Matrix12& C) const;
  /// Adds the bristles of the places that press, of `lugre`; without friction, as they were.
  void add_bristles(const SurfaceLaw& law, const Bristles& bristles, std::vector<Bristle>& now) const;

  /// The place at which the surfaces are nearest to each other.
  struct Nearest {
    double gap, rate;  ///< [m], [m/s]
    Vector3 place;     ///< inertial
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
  Vector3 s_, s_rate_, turning_;  ///< turning: R_12 Omega_2 - Omega_1
};

}  // namespace bielle::mechanism
