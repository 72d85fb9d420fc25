// The equations of small motions about a state, with constant coefficients.
//
// u are increments of the dofs and of the first-order unknowns (n of them, in the order of System), w variations of the
// dofs' rates. With linearise.hpp,
//     M da + C dv + K u + (B^T + F) lambda = 0,     B u = 0 (holonomic),   B dv + S u = 0 (non-holonomic rows).
// How dv and da follow from u depends on the axes in which a shape that is constant but for exp(s t) is seen. They turn
// with an angular velocity w_F of each node, which is zero (`inertial`) or the node's own (`turning`):
//     dv = s dx + w_F~ dx,                   dOmega    = s dTheta + (R^T w_F)~ dTheta,
//     da = s dv + w_F~ dv,                   dOmegadot = s dOmega + (R^T w_F - Omega)~ dOmega,
// that is dv = (s + W) u, da = (s + Z) dv with block diagonal W, Z, and
//     [(s M + C + M Z)(s + W) + K] u + (B^T + F) lambda = 0.
// Of first-order unknowns, dv is the variation of ydot, and W, Z vanish.
//
// In a steady motion the coefficients are constant in axes of the right kind: of rotors with axial symmetry in inertial
// ones, of blades that turn as a whole in those that turn with their nodes (steadiness.hpp).
#pragma once

#include <vector>

#include "mechanism/system/linearise.hpp"

namespace bielle::mechanism {

enum class ModeAxes { inertial, turning };

struct LinearisedEquations {
  using Sparse = SystemMatrices::Sparse;
  int dofs = 0;    ///< the first of the n unknowns
  Sparse M, C, K;  ///< (n, n); C with M Z
  Sparse W;        ///< (n, n)
  Sparse B, S, F;  ///< (constraints, n), (constraints, n), (n, constraints): of those in the equations alone
  std::vector<char> nonholonomic;  ///< of each constraint
  std::vector<int> multiplier;     ///< its number in the system
  /// Each unknown has a group: translations, or turns, of one node are a group, whose blocks rounding errors fill
  /// whatever the axes; other unknowns are a group each. If the list is empty, all unknowns are a group each.
  std::vector<int> group;
  std::vector<char> turns;  ///< (n) whether the unknown is a turn of a node
  VectorX left_over;        ///< (n) how well the equations of motion hold: residual, and rounding of the unknowns

  int unknowns() const { return static_cast<int>(K.rows()); }     ///< n
  int constraints() const { return static_cast<int>(B.rows()); }  ///< in the equations
  int states() const { return unknowns() + dofs; }                ///< of the pencil: [u; w], w the rates of the dofs
};

/// @param environment  that the state stands under
LinearisedEquations linearised_equations(const System& system, const Environment& environment, const State& state,
                                         ModeAxes axes);

}  // namespace bielle::mechanism
