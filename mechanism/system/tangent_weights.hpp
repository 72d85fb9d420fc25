// Weights of the parts of a global tangent.
#pragma once

namespace bielle::mechanism {

/// The tangent is  stiffness * K T(Dq) + damping * C + mass * M  on dof columns, stiffness * K + first_order * C on
/// first-order columns; rows and columns of multipliers (B, B^T) have the weight `constraint` instead of `stiffness`.
struct TangentWeights {
  double stiffness = 1, damping = 0, mass = 0, first_order = 0, constraint = 1;
  /// Rows of non-holonomic constraints contain only their B (the part that multiplies velocities), which relates
  /// accelerations. This is used for the systems [M B^T; B 0] of a consistent start, and for statics.
  bool acceleration_level = false;
  /// Rows of holonomic constraints contain d(B v)/dq (weighted by `stiffness`) and B (weighted by `damping`) instead of
  /// B: the derivative of dPhi/dt. The other rows are then meaningless.
  bool velocity_level = false;
  /// Derivatives of forces by multipliers, df/dlambda, have the weight one; otherwise they have the weight `stiffness`.
  /// They are in the columns of multipliers like B^T, but follow from forces, not from constraints.
  bool reactions = false;
};

}  // namespace bielle::mechanism
