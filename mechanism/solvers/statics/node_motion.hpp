// Motion of nodes along a path of equilibria, and a criterion whether its ends describe a whole increment of the load.
//
// An increment from q_0 to q_1 is described by the linear responses at its two ends, d_0 and d_1 (dq/ds times the
// increment), if the trapezoidal rule gives the computed motion d = q_1 - q_0, and the response has not changed by more
// than that motion:
//     |d - (d_0 + d_1)/2| <= 0.2 |d|,   |d_1 - d_0| <= |d|      for each node, displacements and rotations separately.
// For a scalar equilibrium with snap-through (a cubic load-displacement curve) one of the two conditions is violated at
// any load. One condition alone, or a multiple of d_0 alone, is satisfied at some loads: a tangent intersects a cubic
// once more, far away.
#pragma once

#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Motion of a node, in inertial components.
struct NodeMotion {
  Vector3 displacement = Vector3::Zero();  ///< [m]
  Vector3 turn = Vector3::Zero();          ///< rotation vector [rad]
};
using NodeMotions = std::vector<NodeMotion>;  ///< one for each node of the model

/// Moves a state by increments on the group, of first-order unknowns and of multipliers.
/// @param motion  applied fraction of the prescribed motions, see LoadRamp
/// @param delta   (size)
State displaced(const System& system, const State& base, double motion, const VectorX& delta);

/// Returns the motions to first order, along increments (dofs or more) and a change of the fraction of prescribed
/// motions.
NodeMotions motions_along(const System& system, const State& base, const VectorX& delta, double motion);

NodeMotions motions_between(const State& from, const State& to);

/// Decides whether increments are described by their ends.
class IncrementMeasure {
 public:
  /// @param state  state at the start of an analysis: its size defines small motions
  explicit IncrementMeasure(const State& state);
  /// Returns whether a motion is so small that it needs no check.
  bool small(const NodeMotions& motion) const;
  /// Returns the difference of an increment from the description by its ends: more than one is too far. @param
  /// begin,end  d_0, d_1
  double bend(const NodeMotions& begin, const NodeMotions& end, const NodeMotions& found) const;
  /// Returns the same for a correction by Newton's method and the next correction: it must be at most half as large.
  double unsettled(const NodeMotions& correction, const NodeMotions& second) const;

 private:
  double displacement_;  ///< limit of small displacements [m]
};

}  // namespace bielle::mechanism
