// Searches for unknowns whose equations are balances (FlowBalance): pressures of junctions without volume.
//
//     f_i(y) = 0,      f_i never decreases as y_i grows, and is constant without flow
// The other unknowns are fixed. Newton's direction d solves (df/dy + e) d = -f with a small e, so that constant ranges
// give long steps instead of infinite ones. Along it the slope s(t) = d . f(y + t d) begins below zero and, because f
// never decreases, changes its sign at most once: this zero is bracketed between the bounds of the unknowns, by
// geometric bisection first, since a valve may open after a millionth of the distance. If f is the gradient of a convex
// function, as it is for flows that are functions of pressure differences (its "content": W. Millar, Phil. Mag. 42
// (1951) 1150), Newton's method with this search converges globally; if s stays below zero up to the bounds, there is
// no balance.
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
  /// The object keeps a reference.
  explicit BalanceSearch(const System& system);
  bool empty() const { return balances_.empty(); }  ///< no equation is a balance

  /// Returns whether a balance's unknown is beyond its bounds: such a value is no solution, even if rounding hides the
  /// residual.
  bool beyond_bounds(const State& state) const;
  /// Solves the balances of a state for their own unknowns only.
  /// @returns whether they were found; otherwise the state is unchanged, and `why` gives the reason
  bool find(const Environment& environment, State& state);
  /// Returns the reason why the last search failed: "0.0001 m^3/s are left for pressure of junction 'j': more flows in
  /// than
  /// ..". It is empty if the search succeeded, or did not converge.
  const std::string& why() const { return why_; }

 private:
  /// An unknown and its equation.
  struct Balance {
    int unknown;  ///< index among the first-order unknowns
    FlowBalance::Range range;
  };
  /// A member that adds to the balances.
  struct Member {
    std::size_t number;
    std::vector<std::pair<int, int>> rows;  ///< local row, and number of the balance
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
  VectorX f_, terms_, y_, d_;  ///< values of the balances, sums of the sizes of their terms, unknowns, direction
  MatrixX J_;                  ///< df/dy
  VectorX local_;
  MatrixX K_, unused_;
  LUFactors factors_;
  std::string why_;
};

}  // namespace bielle::mechanism
