// Which crossings of a motion lie within a step, and where.
//
// A crossing is a function g of the state whose zero begins another branch (model/component.hpp). Its sign at the
// start of a step is that of the side that the motion is on; where g vanishes there, it is the side that the motion has
// just come to. A step that ends on the other side holds a zero, which is bracketed by the ends of steps of other sizes
// and located by regula falsi with halved weights (Illinois), a zero at a time: the earliest of those found. A zero
// that changes nothing is looked for in the same way on the motion between the ends of the accepted step, which stays
// as it is.
//
// M. Dowell, P. Jarratt, BIT 11 (1971) 168 (Illinois).
#pragma once

#include <functional>
#include <vector>

#include "mechanism/model/archive.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class CrossingWatch {
 public:
  explicit CrossingWatch(const System& system);
  bool idle() const { return system_.crossings().empty(); }

  /// Looks at the start of a step.
  /// @param passed     crossings that have been met there: on which side of its zero each is, rounding would tell
  /// @param one_alone  of several, only the farthest beyond its zero
  /// @returns the crossings that have come to another side since the last step ended: what they look at has jumped
  std::vector<int> begin(const State& state, const Environment& environment, const std::vector<int>& passed,
                         bool one_alone = false);
  /// Whether a step of the size h that ends in a state holds a crossing that ends it: after which the motion is
  /// restarted or stops. Begins the search for the first one if it does.
  /// @param tolerance  how far past the zero the step may end [s]
  bool found(const State& end, const Environment& environment, double h, double tolerance);
  /// The size of the step to try next [s].
  double proposal() const;
  /// Takes the end of a step of that size into account.
  void narrow(const State& end, const Environment& environment, double h);
  /// Whether the upper end of the bracket is as near to the zero as wanted: the step of that size ends past it.
  bool located() const;
  double behind() const { return high_; }  ///< that size [s]
  /// The crossings of the step last looked at, by number; the motion has come to their other sides.
  std::vector<int> pass();

  /// A crossing that ends no step.
  struct Noted {
    double time = 0;  ///< [s]
    int crossing = 0;
  };
  /// Those of an accepted step, whose begin and end were last looked at: where they lie on the motion between its ends.
  /// @param begin     [s]
  /// @param end       [s]
  /// @param between   the state at a time between them
  /// @param tolerance how far behind the zero the time may lie [s]
  std::vector<Noted> pass_noted(double begin, double end, const std::function<State(double)>& between,
                                const Environment& environment, double tolerance);
  void exchange(Archive& archive);

 private:
  double shortest() const;  ///< step that is tried [s]
  /// Crossings with a zero between the start and values at the end of a step.
  void collect(const VectorX& values, std::vector<int>& crossed) const;
  bool has_crossed(int k, double value) const;
  double locate_noted(int k, double begin, double end, const std::function<State(double)>& between,
                      const Environment& environment, double tolerance);
  /// Of those that let go one by one, leaves the one that is farthest beyond; the others stay on their sides.
  void let_one_go(std::vector<int>& crossed, const VectorX& values) const;
  bool counts(int k) const;  ///< the direction in which a crossing from its side goes

  const System& system_;
  CrossingValues values_;
  std::vector<bool> ends_step_;  ///< by crossing
  VectorX sides_;                ///< +1 or -1: where the motion is; 0: not known yet
  VectorX at_start_;             ///< values at the start of the step
  VectorX at_low_, at_high_;     ///< values at the ends of the bracket
  VectorX weight_;               ///< of the lower end's values relative to the upper end's
  std::vector<int> crossed_;     ///< at the upper end
  std::vector<int> last_end_;    ///< of each crossing: +1 or -1, the end that moved last
  double low_ = 0, high_ = 0;    ///< sizes of steps [s]
  double tolerance_ = 0;         ///< [s]
  double step_ = 0;              ///< whole size [s]
};

}  // namespace bielle::mechanism
