// Increments of the load that leave the path of equilibria: past a limit point of the load there is no equilibrium
// near, and Newton's method may find one far away without a word; on the way to a large increment it may find another
// one although the path goes on.
//
// Each increment is judged by its ends (node_motion.hpp), which takes a residual and a solution with factors at hand,
// and by the sign of the determinant at both. If they do not tell all of it, the path is followed through the
// increment by Newton's continuation (P. Deuflhard, Newton Methods for Nonlinear Problems, Springer 2004, ch. 5): at
// each point
//     K c = -r,   K b = -dr/ds,   q <- q o (c + b ds),
// one factorisation and no iteration, with steps ds that their own ends tell. It ends at the equilibrium of the path,
// which takes the place of another one; or where steps become too short: there the path turns.
#pragma once

#include <optional>

#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/node_motion.hpp"
#include "mechanism/solvers/statics/statics.hpp"

namespace bielle::mechanism {

class PathWatch {
 public:
  /// @param state  where the analysis sets off
  PathWatch(const LoadRamp& ramp, Equilibrium& equilibrium, const State& state)
      : ramp_(ramp), system_(ramp.system()), equilibrium_(equilibrium), measure_(state) {}

  struct Point {
    double factor;
    State state;
  };
  struct Verdict {
    bool followed = false;         ///< the ends did not tell all: the path was followed
    bool moved = false;            ///< the equilibrium of the path has taken the place of the one that was found
    std::optional<LoadJump> jump;  ///< the path turns on the way
    std::optional<Point> below;    ///< the last equilibrium before the jump
    std::optional<Point> landing;  ///< where the path begins that leads from just past the jump to the one found
    bool sign_changed = false;     ///< of the determinant, from the one end that was found to the other
  };
  /// @param from  an equilibrium, or where the analysis sets off; @param to  what `equilibrium` has just found from it
  Verdict look(const Point& from, Point& to);

  /// Follows the path from an equilibrium to a load factor. @returns whether it came there; otherwise `point` is the
  /// last equilibrium that was found before the path turns or is lost
  /// @param least     steps that are a smaller part of the way than this are too short
  /// @param expected  an equilibrium at the end that is taken where the path leads next to it, or null
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
