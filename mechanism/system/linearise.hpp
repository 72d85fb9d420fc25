// The linearised equations of motion about a state, as matrices: for eigenmodes, state space and users of the tangent.
//
// The increments of dofs and first-order unknowns are x (n of them, in the order of System); the variations of rates
// and accelerations are dv and da (for first-order unknowns, dv is the variation of ydot and da is zero):
//     dr = K dx + C dv + M da + (B^T + F) dlambda,
//     dPhi = B dx  (holonomic rows),   d(B v + c) = B dv + S dx  (non-holonomic rows).
// A node's dv and da are those of its velocities (for rotations: Omega), which at rest are rates of dx. The convective
// terms of carried nodes are in K and C. Rows of B that are out of the equations (redundant, switched off) are zero.
#pragma once

#include <Eigen/SparseCore>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct SystemMatrices {
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse K, C, M;  ///< (n, n), n = dofs + first-order unknowns; K includes d(B^T lambda)/dx
  Sparse B, S;     ///< (multipliers, n)
  Sparse F;        ///< (n, multipliers): derivatives of forces and flows by multipliers of other components
};

SystemMatrices linearise(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
