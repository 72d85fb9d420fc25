// Detects the events of a motion within a step, and locates them.
//
// An event function g of the state begins another branch at its zero (model/component.hpp). Its sign at the start of a
// step defines the side on which the motion is; if g is zero there, it is the side that the motion has just reached. A
// step that ends on the other side contains a zero, which is bracketed by the ends of steps of different sizes and
// located by regula falsi with halved weights (Illinois); only the earliest of several zeros is located. A zero that
// changes nothing is located in the same way on the interpolated motion of the accepted step, which is not changed.
//
// M. Dowell, P. Jarratt, BIT 11 (1971) 168 (Illinois).
#pragma once

#include <functional>
#include <vector>

#include "mechanism/model/archive.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class EventLocator {
 public:
  explicit EventLocator(const System& system);
  bool idle() const { return system_.event_functions().empty(); }

  /// Evaluates the event functions at the start of a step.
  /// @param passed     events that occurred there: their sides would be determined by rounding
  /// @param one_alone  whether only the one farthest beyond its zero is returned if there are several
  /// @returns the events whose functions have changed sign since the end of the last step, because of a discontinuity
  std::vector<int> begin(const State& state, const Environment& environment, const std::vector<int>& passed,
                         bool one_alone = false);
  /// Returns whether a step of the size h that ends in a state contains an event that ends it, after which the motion
  /// is restarted or stops. If it does, the search for the first one begins.
  /// @param tolerance  largest distance of the step's end past the zero [s]
  bool found(const State& end, const Environment& environment, double h, double tolerance);
  /// Returns the size of the next trial step [s].
  double proposal() const;
  /// Narrows the bracket by the end of a step of that size.
  void narrow(const State& end, const Environment& environment, double h);
  /// Returns whether the upper end of the bracket is near enough to the zero: the step of that size ends past it.
  bool located() const;
  double behind() const { return high_; }  ///< size of this step [s]
  /// Completes the events of the last step, and returns their numbers; the motion is then on their other sides.
  std::vector<int> pass();

  /// An event that does not end a step.
  struct Noted {
    double time = 0;  ///< time [s]
    int event_function = 0;
  };
  /// Completes such events of an accepted step, whose start and end were evaluated last, and locates them on the
  /// interpolated motion.
  /// @param begin     start of the step [s]
  /// @param end       end of the step [s]
  /// @param between   returns the state at a time between them
  /// @param tolerance largest distance of the time past the zero [s]
  std::vector<Noted> pass_noted(double begin, double end, const std::function<State(double)>& between,
                                const Environment& environment, double tolerance);
  void exchange(Archive& archive);

 private:
  double shortest() const;  ///< shortest trial step [s]
  /// Collects the event functions that change sign between the start and the end of a step.
  void collect(const VectorX& values, std::vector<int>& crossed) const;
  bool has_crossed(int k, double value) const;
  double locate_noted(int k, double begin, double end, const std::function<State(double)>& between,
                      const Environment& environment, double tolerance);
  /// Keeps only the one farthest beyond its zero of the events of which one may occur at a time; the others stay on
  /// their sides.
  void let_one_go(std::vector<int>& crossed, const VectorX& values) const;
  bool counts(int k) const;  ///< whether a sign change from the present side is in the direction of the event

  const System& system_;
  EventFunctionValues values_;
  std::vector<bool> ends_step_;  ///< for each event function
  VectorX sides_;                ///< side of the motion, +1 or -1; 0: not known yet
  VectorX at_start_;             ///< values at the start of the step
  VectorX at_low_, at_high_;     ///< values at the ends of the bracket
  VectorX weight_;               ///< weight of the lower end's values relative to the upper end's
  std::vector<int> crossed_;     ///< events at the upper end
  std::vector<int> last_end_;    ///< for each event function: +1 or -1, the end that moved last
  double low_ = 0, high_ = 0;    ///< bracket, as sizes of steps [s]
  double tolerance_ = 0;         ///< [s]
  double step_ = 0;              ///< size of the full step [s]
};

}  // namespace bielle::mechanism
