// Searches for unknowns whose equations are balances (FlowBalance): pressures of junctions without volume.
//
//     f_i(y) = 0,      f_i never falls as y_i grows, and is flat where nothing flows
// With the other unknowns as they are. Newton's direction d solves (df/dy + e) d = -f, e a little that makes flat
// ranges long ways in place of endless ones. Along it the slope s(t) = d . f(y + t d) begins below zero and, because f
// never falls, crosses zero once at most: that crossing is bracketed between the bounds of the unknowns, by geometric
// bisection first, since a valve may open after a millionth of the way. If f is the gradient of a convex function, as
// flows that follow pressure differences are (its "content": W. Millar, Phil. Mag. 42 (1951) 1150), Newton's method
// with this search converges from everywhere; if s stays below zero up to the bounds, nothing balances.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/model/flow_balance.hpp"
#include "mechanism/system/system.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {

class BalanceSearch {
 public:
  /// Keeps a reference.
  explicit BalanceSearch(const System& system);
  bool empty() const { return balances_.empty(); }  ///< no equation is a balance

  /// Whether a balance's unknown is beyond its bounds: no solution, but a residual that rounding hides.
  bool beyond_bounds(const State& state) const;
  /// Brings the balances of a state to zero by their own unknowns alone.
  /// @returns whether they were found; otherwise the state is as it was, and `why` tells
  bool find(const Environment& environment, State& state);
  /// Why the last search found nothing: "0.0001 m^3/s are left for pressure of junction 'j': more flows in than ..".
  /// Empty where it found something, or did not settle.
  const std::string& why() const { return why_; }

 private:
  /// An unknown and its equation.
  struct Balance {
    int unknown;  ///< among the first-order unknowns
    FlowBalance::Range range;
  };
  /// A member that adds to the balances.
  struct Member {
    std::size_t number;
    std::vector<std::pair<int, int>> rows;  ///< local row, number of the balance
    bool has_tangent;
  };
  enum class Way { found, blocked, refused };
  void note_rows(const Slots& slots, int row, Member& member) const;
  void evaluate(const State& state, const Environment& environment, bool with_slopes);
  bool balanced() const;
  bool set_direction();
  void move(State& state, double part) const;
  double slope(State& state, const Environment& environment, double part);
  double longest_part(int& first) const;
  Way go(State& state, const Environment& environment);
  Way bracket(State& state, const Environment& environment, double low, double high, double enough);
  void explain(int blocked);

  const System& system_;
  std::vector<Balance> balances_;
  std::vector<Member> members_;
  VectorX f_, terms_, y_, d_;  ///< of the balances: values, sums of the sizes of their terms, unknowns, direction
  MatrixX J_;                  ///< df/dy
  VectorX local_;
  MatrixX K_, unused_;
  LUFactors factors_;
  std::string why_;
};

}  // namespace bielle::mechanism
