// Static equilibrium along the path of the load factor s, past its limit points: snap-through and snap-back.
//
// A point of the path is (q, s) with r(q, s) = 0. The next point, with the increment Dq on the configuration group (and
// of multipliers and first-order unknowns), satisfies
//     r(q o exp(Dq), s) = 0,   |Dq|_W = arc,    |Dq|^2_W = sum |dx_i|^2/(L^2 n_x) + sum |dTheta_i|^2/n_Theta + ...
// by Newton's method, with the arc-length condition linearised consistently (K. Schweizerhof, P. Wriggers, Comput.
// Meth. Appl. Mech. Engng 59 (1986) 261); each iteration solves one factorised tangent for two right-hand sides (E.
// Riks, Int. J. Solids Struct. 15 (1979) 529; M. Crisfield, Comput. Struct. 13 (1981) 55):
//     K a = -r,   K b = -dr/ds,    dDq = a + ds b.
// Here L is the mechanism's extent, n_x and n_Theta are the numbers of free translations and rotations, so that |Dq|_W
// is a mean displacement relative to the mechanism's size, or a mean rotation [rad], in any units; modal amplitudes are
// weighted by their stiffness relative to that of translations. The load factor is not included: its scale is chosen by
// the user.
//
// The first guess is along the tangent b, oriented by the previous step (never by the sign of a determinant: a
// bifurcation does not reverse the path). Steps that bend by more than 45 degrees are halved like failed steps. If
// ds/darc changes its sign, the limit point in between is located, and becomes a point of the path.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/statics/critical_point.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

/// End of a path: at a load factor, or at a displacement of a node from its initial position.
struct PathEnd {
  std::optional<double> load_factor;
  int node = 0;
  Vector3 direction = Vector3::Zero();  ///< unit vector, inertial; zero: the distance is used
  double displacement = 0;              ///< [m]
};

struct ContinuationOptions {
  PathEnd end;
  /// The first step is this fraction of the distance by the linear response, and no step is longer than four times
  /// that; 0: a twentieth, with steps as long as Newton's method converges fast.
  int steps = 0;
  int most_points = 1000;
  std::vector<double> stops;  ///< load factors at which the path has points, ascending
};

struct PathPoint {
  double load_factor = 0;
  int iterations = 0;
  bool limit = false;  ///< it is a maximum or minimum of the load factor
  double done = 0;     ///< completed fraction, 0..1
  /// Number of motions of negative stiffness; no value if not known, as at a limit point.
  std::optional<int> unstable;
  /// A bifurcation before this point: stability has changed without a limit point. The path continues straight.
  std::optional<CriticalPoint> bifurcation;
};

/// Follows the path from the state to its end, which is reached exactly. It starts with a growing load factor; from a
/// state that is already loaded, towards the end.
/// @param environment  environment with gravity of load factor 1
/// @param start        loads applied to the state; @returns those at the end
/// @param record       called at each point
/// @throws ComputationError with the load factor after which no further point was found and the reason; if the end was
///         not reached within the number of points; if nothing moves with the load factor
Loaded follow_by_continuation(const System& system, const Environment& environment, const Loaded& start,
                              const ContinuationOptions& path, const NewtonOptions& options, State& state,
                              const std::function<void(const State&, const PathPoint&)>& record = {});

}  // namespace bielle::mechanism
