// What a tangent of the whole is made of.
#pragma once

namespace bielle::mechanism {

/// The tangent is  stiffness * K T(Dq) + damping * C + mass * M  on dof columns, stiffness * K + first_order * C on
/// first-order columns; rows and columns of multipliers (B, B^T) carry the weight `constraint` in place of `stiffness`.
struct TangentWeights {
  double stiffness = 1, damping = 0, mass = 0, first_order = 0, constraint = 1;
  /// Rows of non-holonomic constraints hold their B (the part that multiplies velocities) alone: what relates
  /// accelerations. For the systems [M B^T; B 0] of a consistent start, and for statics.
  bool acceleration_level = false;
  /// Rows of holonomic constraints hold d(B v)/dq (weighted by `stiffness`) and B (weighted by `damping`) in place of
  /// B: the derivative of dPhi/dt. Other rows mean nothing then.
  bool velocity_level = false;
  /// Derivatives of forces by multipliers, df/dlambda, count in full whatever `stiffness` is; otherwise they have its
  /// weight. They stand in the columns of multipliers like B^T, but follow from forces, not from constraints.
  bool reactions = false;
};

}  // namespace bielle::mechanism
