// The equations of motion about a state, as matrices: for eigenmodes, state space and whoever reads a tangent.
//
// With x the increments of dofs and first-order unknowns (n of them, in the order of System), rates and accelerations
// varied by dv and da (of first-order unknowns: dv is that of ydot, da is nothing),
//     dr = K dx + C dv + M da + (B^T + F) dlambda,
//     dPhi = B dx  (holonomic rows),   d(B v + c) = B dv + S dx  (non-holonomic rows).
// A node's dv and da are those of its velocities (of rotations: Omega), which at rest are rates of dx. What carries
// rigidly has its convective terms in K and C. Rows of B that are out of the equations (redundant, switched off) are
// zero.
#pragma once

#include <Eigen/SparseCore>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct SystemMatrices {
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse K, C, M;  ///< (n, n), n = dofs + first-order unknowns; K with d(B^T lambda)/dx
  Sparse B, S;     ///< (multipliers, n)
  Sparse F;        ///< (n, multipliers): forces and flows that depend on multipliers of others
};

SystemMatrices linearise(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
