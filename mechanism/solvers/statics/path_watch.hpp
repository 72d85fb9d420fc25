// Detects increments of the load that leave the path of equilibria: past a limit point of the load there is no
// equilibrium nearby, and Newton's method may find a distant one; within a large increment it may find another one
// although the path continues.
//
// Each increment is checked by its ends (node_motion.hpp), which costs a residual and a solution with existing factors,
// and by the sign of the determinant at both. If the ends do not describe it, the path is followed through the
// increment by Newton's continuation (P. Deuflhard, Newton Methods for Nonlinear Problems, Springer 2004, ch. 5): at
// each point
//     K c = -r,   K b = -dr/ds,   q <- q o (c + b ds),
// one factorisation and no iteration, with steps ds that their own ends describe. It ends at the equilibrium of the
// path, which replaces another one; or if steps become too short: there the path turns back.
#pragma once

#include <optional>

#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/node_motion.hpp"
#include "mechanism/solvers/statics/statics.hpp"

namespace bielle::mechanism {

class PathWatch {
 public:
  /// @param state  state at the start of the analysis
  PathWatch(const LoadRamp& ramp, Equilibrium& equilibrium, const State& state)
      : ramp_(ramp), system_(ramp.system()), equilibrium_(equilibrium), measure_(state) {}

  struct Point {
    double factor;
    State state;
  };
  struct Verdict {
    bool followed = false;         ///< the ends did not describe the increment: the path was followed
    bool moved = false;            ///< the equilibrium of the path has replaced the one that was found
    std::optional<LoadJump> jump;  ///< the path turns back within the increment
    std::optional<Point> below;    ///< the last equilibrium before the jump
    std::optional<Point> landing;  ///< start of the path that leads from just past the jump to the equilibrium found
    bool sign_changed = false;     ///< sign of the determinant changed between the found ends
  };
  /// @param from  an equilibrium, or the start of the analysis; @param to  the equilibrium that has just been found
  ///              from it
  Verdict look(const Point& from, Point& to);

  /// Follows the path from an equilibrium to a load factor. @returns whether it was reached; otherwise `point` is the
  /// last equilibrium found before the path turns back or is lost
  /// @param least     steps that are a smaller fraction of the distance are too short
  /// @param expected  an equilibrium at the end that is used if the path leads near it, or null
  bool follow(Point& point, double factor, double least = finest, const State* expected = nullptr);
  LoadJump jump_between(const Point& below, const Point& above) const;

 private:
  static constexpr double finest = 1e-7;
  bool told_by_ends(const Point& from, const Point& to);
  double advance(const Point& here, const Continuation& at_begin, Point& trial, Continuation& at_end);
  bool arrive(Point& point, const Point& reached, const Continuation& there);
  void close_in(Point& below, double beyond);

  const LoadRamp& ramp_;
  const System& system_;
  Equilibrium& equilibrium_;
  IncrementMeasure measure_;
};

}  // namespace bielle::mechanism
