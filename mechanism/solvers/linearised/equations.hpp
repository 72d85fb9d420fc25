// The equations of small motions about a state, with constant coefficients.
//
// The vector u contains increments of the dofs and of the first-order unknowns (n of them, in the order of System), and
// w variations of the dofs' rates. With linearise.hpp,
//     M da + C dv + K u + (B^T + F) lambda = 0,     B u = 0 (holonomic),   B dv + S u = 0 (non-holonomic rows).
// The dependence of dv and da on u is determined by the axes in which a shape is constant except for the factor exp(s
// t). They rotate with an angular velocity w_F of each node, which is zero (`inertial`) or the node's own (`turning`):
//     dv = s dx + w_F~ dx,                   dOmega    = s dTheta + (R^T w_F)~ dTheta,
//     da = s dv + w_F~ dv,                   dOmegadot = s dOmega + (R^T w_F - Omega)~ dOmega,
// that is dv = (s + W) u, da = (s + Z) dv with block diagonal W, Z, and
//     [(s M + C + M Z)(s + W) + K] u + (B^T + F) lambda = 0.
// For first-order unknowns, dv is the variation of ydot, and W, Z are zero.
//
// In a steady motion the coefficients are constant in suitable axes: for rotors with axial symmetry in inertial axes,
// for blades that rotate as a whole in axes that rotate with their nodes (steadiness.hpp).
#pragma once

#include <vector>

#include "mechanism/system/linearise.hpp"

namespace bielle::mechanism {

enum class ModeAxes { inertial, turning };

struct LinearisedEquations {
  using Sparse = SystemMatrices::Sparse;
  int dofs = 0;                    ///< number of dofs, the first of the n unknowns
  Sparse M, C, K;                  ///< (n, n); C includes M Z
  Sparse W;                        ///< (n, n)
  Sparse B, S, F;                  ///< (constraints, n), (constraints, n), (n, constraints), active constraints only
  std::vector<char> nonholonomic;  ///< type of each constraint
  std::vector<int> multiplier;     ///< number of each constraint in the system
  /// Each unknown has a group: the translations, or the rotations, of one node are a group, whose blocks have rounding
  /// errors in all entries for any axes; every other unknown is a group of its own. If the list is empty, every unknown
  /// is a group of its own.
  std::vector<int> group;
  std::vector<char> turns;  ///< (n) whether the unknown is a rotation of a node
  VectorX left_over;        ///< (n) error of the equations of motion: residual, and rounding of the unknowns

  int unknowns() const { return static_cast<int>(K.rows()); }     ///< n
  int constraints() const { return static_cast<int>(B.rows()); }  ///< number of active constraints
  int states() const { return unknowns() + dofs; }                ///< states of the pencil: [u; w], rates w of the dofs
};

/// @param environment  environment of the state
LinearisedEquations linearised_equations(const System& system, const Environment& environment, const State& state,
                                         ModeAxes axes);
/// The same from given matrices. @param residual  (System::size) of the equations at the state
LinearisedEquations linearised_equations(const System& system, const State& state, ModeAxes axes,
                                         SystemMatrices matrices, const VectorX& residual);

}  // namespace bielle::mechanism
