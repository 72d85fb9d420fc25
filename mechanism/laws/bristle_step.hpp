// Integration of the bristles of `lugre` (friction_law.hpp) over one step of size h, by the implicit Euler method,
// which is stable for any stiffness. With the sliding velocity v at the end of the step, s = |v|, and the deflection
// z_0 at its beginning,
//     z = (z_0 + h v)/(1 + h sigma_0 s/mu(s)),   u = v - sigma_0 s z/mu(s),   f = sigma_0 z + sigma_1(s) u + sigma_2 v
// Here f is the resistance per unit of the normal force. As a function of v and z_0 it is f = G(s) z_0 + H(s) v. The
// dissipated power is f . v - sigma_0 z . u >= 0; the power stored by bristles, sigma_0 z . u, is returned later.
#pragma once

#include "mechanism/laws/friction_law.hpp"
#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

struct BristleStep {
  Vector3 z, force;     ///< z [m], force [-]
  double by_before;     ///< df/dz_0, times the identity [1/m]
  Matrix3 by_slip;      ///< df/dv [s/m]; at rest, where it does not exist, the value for v = 0 along all directions
  double lost, stored;  ///< powers per unit of the normal force [m/s]
  /// @param before,slip  z_0 [m], v [m/s] @param h  [s], not negative
  BristleStep(const FrictionLaw& law, const Vector3& before, const Vector3& slip, double h);
};

}  // namespace bielle::mechanism
