// Static equilibrium along the path of the load factor s, past its limit points: snap-through and snap-back.
//
// A point of the path is (q, s) with r(q, s) = 0. From a point, with Dq the increment on the configuration group (and
// of multipliers and first-order unknowns), the next one satisfies
//     r(q o exp(Dq), s) = 0,   |Dq|_W = arc,    |Dq|^2_W = sum |dx_i|^2/(L^2 n_x) + sum |dTheta_i|^2/n_Theta + ...
// by Newton's method, the condition of length linearised consistently (K. Schweizerhof, P. Wriggers, Comput. Meth.
// Appl. Mech. Engng 59 (1986) 261); each iteration solves one factorised tangent for two right-hand sides (E. Riks,
// Int. J. Solids Struct. 15 (1979) 529; M. Crisfield, Comput. Struct. 13 (1981) 55):
//     K a = -r,   K b = -dr/ds,    dDq = a + ds b.
// L is the mechanism's extent, n_x and n_Theta the numbers of free translations and rotations, so that |Dq|_W is a mean
// displacement relative to the mechanism's size, or a mean rotation [rad], in any units; modal amplitudes are weighted
// by their stiffness relative to that of translations. The load factor does not count: its scale is the user's.
//
// The first guess lies along the tangent b, oriented by the step before (never by the sign of a determinant: a
// bifurcation does not turn the path around). Steps that bend by more than 45 degrees are halved like those that fail.
// Where ds/darc changes its sign the limit point in between is found, and is a point of the path itself.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/statics/critical_point.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

/// Where a path ends: at a load factor, or at a displacement of a node from where it is drawn.
struct PathEnd {
  std::optional<double> load_factor;
  int node = 0;
  Vector3 direction = Vector3::Zero();  ///< of length one, inertial; zero: the distance counts
  double displacement = 0;              ///< [m]
};

struct PathOptions {
  PathEnd end;
  /// The first step is this fraction of the way by the linear response, and none is longer than four times that; 0: a
  /// twentieth, and as long as Newton's method converges fast.
  int steps = 0;
  int most_points = 1000;
  std::vector<double> stops;  ///< load factors that are points of the path wherever it crosses them, ascending
};

struct PathPoint {
  double load_factor = 0;
  int iterations = 0;
  bool limit = false;  ///< a maximum or minimum of the load factor
  double done = 0;     ///< part of the way to the end, 0..1
  /// Motions of negative stiffness; none: not known, as at a limit point.
  std::optional<int> unstable;
  /// A bifurcation on the way here: stability changed, and no limit point tells why. The path goes straight on.
  std::optional<CriticalPoint> bifurcation;
};

/// Follows the path from the state to its end, which is reached exactly. It starts with a growing load factor; from a
/// state that is loaded already, towards the end.
/// @param environment  with gravity of load factor 1
/// @param start        what the state stands under; @returns it at the end
/// @param record       called at each point
/// @throws ComputationError with the load factor from where no further point was found and the reason; when the end was
///         not met within the number of points; when nothing moves with the load factor
Loaded follow_path(const System& system, const Environment& environment, const Loaded& start, const PathOptions& path,
                   const NewtonOptions& options, State& state,
                   const std::function<void(const State&, const PathPoint&)>& record = {});

}  // namespace bielle::mechanism
