// How nodes move along a path of equilibria, and whether one increment of the load tells all of it.
//
// An increment from q_0 to q_1 is told by the linear responses at its two ends, d_0 and d_1 (dq/ds times the
// increment), when the trapezoidal rule on them gives the motion that was found, d = q_1 - q_0, and the response has
// not changed by more than that motion:
//     |d - (d_0 + d_1)/2| <= 0.2 |d|,   |d_1 - d_0| <= |d|      for each node, displacements and turns apart.
// For a scalar equilibrium that snaps (a cubic load-displacement curve) one of the two fails whatever the load. Either
// alone, or a multiple of d_0 alone, is met by some loads: a tangent meets a cubic once more, far away.
#pragma once

#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Inertial components.
struct NodeMotion {
  Vector3 displacement = Vector3::Zero();  ///< [m]
  Vector3 turn = Vector3::Zero();          ///< rotation vector [rad]
};
using NodeMotions = std::vector<NodeMotion>;  ///< one for each node of the model

/// A state moved by increments on the group, of first-order unknowns and of multipliers.
/// @param motion  part of the prescribed motions that is applied, see LoadRamp
/// @param delta   (size)
State displaced(const System& system, const State& base, double motion, const VectorX& delta);

/// To first order, along increments (dofs or more) and a change of the part of prescribed motions.
NodeMotions motions_along(const System& system, const State& base, const VectorX& delta, double motion);

NodeMotions motions_between(const State& from, const State& to);

/// Decides whether increments are told by their ends.
class IncrementMeasure {
 public:
  /// @param state  where an analysis sets off: what is small is judged by its size
  explicit IncrementMeasure(const State& state);
  /// Whether a motion is so small that it needs no telling.
  bool small(const NodeMotions& motion) const;
  /// How far an increment is from what its ends tell: more than one is too far. @param begin,end  d_0, d_1
  double bend(const NodeMotions& begin, const NodeMotions& end, const NodeMotions& found) const;
  /// The same of a correction by Newton's method that leaves a second one: no more than half as large.
  double unsettled(const NodeMotions& correction, const NodeMotions& second) const;

 private:
  double displacement_;  ///< that is small [m]
};

}  // namespace bielle::mechanism
