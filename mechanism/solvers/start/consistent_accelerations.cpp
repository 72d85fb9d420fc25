#include "mechanism/solvers/start/consistent_accelerations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>

#include <fmt/format.h>

#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/newton/balance_search.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/acceleration_refusals.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

class AccelerationEquations {
 public:
  /// Initial guess of the search for the accelerations.
  enum class From { nothing, state };
  AccelerationEquations(const System& system, const Environment& environment, State& state, KktMatrix& saddle,
                        From from)
      : system_(system),
        environment_(environment),
        state_(state),
        saddle_(saddle),
        reactions_(system),
        length_(model_length(state)),
        known_(state.multiplier),
        v_(system.dofs()),
        a_(system.dofs()),
        r_(system.size()),
        step_(system.size()),
        begin_(state.first_order),
        size_(system.algebraic().size(), 0.0) {
    system.get_rates(state, v_, a_);
    if (from == From::nothing) {
      a_.setZero();
      state.multiplier.setZero();
      state.first_order_rate.setZero();
      system.set_rates(state, v_, a_);
    }
    evaluate();
  }

  /// Solves the case in which all unknowns enter linearly.
  void solve_linear() {
    if (!saddle_.serves()) return solve_afresh();
    // Factors of nearby positions are used with refinement until the residual is only rounding, because differences of
    // such accelerations are computed.
    constexpr int most = 20;
    constexpr double rounding = 1e-11;
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most; ++iteration) {
      solve();
      move(1);
      const double size = size_of_all();
      if (size == 0 || (size <= rounding && size > 0.1 * before)) return;
      if (size > 0.3 * before) break;
      before = size;
      evaluate();
    }
    evaluate();
    solve_afresh();
  }

  void solve_for_algebraic() {
    const State begun = state_;
    const VectorX a_begun = a_;
    int left = -1;
    std::exception_ptr refusal;
    try {
      left = iterate_for_algebraic(nullptr);
    } catch (const ComputationError&) {
      refusal = std::current_exception();  // singular, or a component cannot be evaluated
    }
    BalanceSearch search(system_);
    if (left == 0 && !search.beyond_bounds(state_)) return;
    if (search.empty()) {
      if (refusal) std::rethrow_exception(refusal);
      throw_unsolved(left, {});
    }
    // The search is repeated, and each iterate includes a search for balances, whose slope may be zero.
    state_ = begun;
    a_ = a_begun;
    evaluate();
    left = iterate_for_algebraic(&search);
    if (left > 0 || search.beyond_bounds(state_)) throw_unsolved(left, search.why());
  }

  /// Forces depend on multipliers: the search starts from the solution of a state nearby, with the factors of its
  /// start.
  /// @returns whether it has been found; otherwise the state is unchanged
  bool continue_with_reactions() {
    constexpr int most = 8;
    const State begun = state_;
    const VectorX a_begun = a_;
    try {
      bool solved = saddle_.factor_with_reactions(environment_, state_);
      double before = std::numeric_limits<double>::infinity();
      for (int iteration = 0; solved && iteration < most; ++iteration) {
        solve();
        if (!step_.allFinite()) break;
        move(1);
        const double size = size_of_all();
        if (settled(size, before)) return true;
        if (size > 0.3 * before) solved = saddle_.factor_with_reactions(environment_, state_);
        before = size;
        evaluate();
      }
    } catch (const ComputationError&) {
      // a component cannot be evaluated
    }
    state_ = begun;
    a_ = a_begun;
    return false;
  }

  /// Solves the case in which forces depend on multipliers.
  void solve_with_reactions() {
    // The first solution ignores the dependence: multipliers are zero in the forces.
    saddle_.factor(environment_, state_);
    const int without = saddle_.determinant_sign();
    solve();
    move(1);
    if (!system_.algebraic().empty()) {
      BalanceSearch search(system_);
      if (!search.empty()) balance(search);
    }
    const VectorX guess = state_.multiplier;
    const State first = state_;
    const VectorX a_first = a_;
    // The search starts from the earlier reactions, if there are any, because few of them change much at an event.
    if (known_.allFinite() && !known_.isZero(0)) {
      state_.multiplier = known_;
      system_.for_each_idle(state_, [&](int multiplier) { state_.multiplier[multiplier] = 0; });
    }
    const Search found = search();
    const State solution = state_;
    const VectorX a_solution = a_;
    // The search is repeated from reactions of the opposite sign.
    state_ = first;
    a_ = a_first;
    state_.multiplier = -guess;
    const Search mirrored = search();
    if (!found.converged && !mirrored.converged)
      throw_no_accelerations(system_, state_.time, found.worst, found.flips(without) || mirrored.flips(without));
    if (found.converged && mirrored.converged) check_same(solution.multiplier, state_.multiplier);
    if (found.converged) {
      state_ = solution;
      a_ = a_solution;
      system_.set_rates(state_, v_, a_);
    }
    if ((found.converged ? found : mirrored).determinant_sign != without)
      throw_ambiguous_accelerations(system_, state_.time,
                                    "the solution that was found does not continue the one without such forces", -1);
  }

 private:
  void solve_afresh() {
    saddle_.factor(environment_, state_);
    solve();
    move(1);
    saddle_.serve_no_more();  // these factors do not serve other positions
  }

  void evaluate() {
    const int m = system_.multipliers();
    VectorX velocity(m), acceleration(m);
    reactions_.balance(environment_, state_);
    system_.residual(state_, environment_, r_);
    system_.constraint_rates(state_, environment_, velocity, acceleration);
    r_.tail(m) = acceleration;
    system_.for_each_idle(state_, [&](int multiplier) { r_[system_.size() - m + multiplier] = 0; });
  }

  /// Computes the step of Newton's method with the last factors.
  void solve() {
    saddle_.solve(r_, step_);
    const VectorX& floor = saddle_.floor();
    if (!(floor.array() > 0).any()) return;
    // Forces that are only balanced by the floor of the masses would cause unlimited accelerations. The terms floor
    // times acceleration equal these forces, and are elsewhere only of the size of the floor; they are removed.
    r_.head(system_.dofs()) += floor.cwiseProduct(step_.head(system_.dofs()));
    saddle_.solve(r_, step_);
  }

  void move(double part) {
    const int n = system_.dofs();
    a_ += part * step_.head(n);
    system_.set_rates(state_, v_, a_);
    state_.first_order_rate += part * step_.segment(n, system_.first_orders());
    for (const int k : system_.algebraic()) {
      state_.first_order_rate[k] = 0;
      state_.first_order[k] += part * step_[n + k];
    }
    state_.multiplier += part * step_.tail(system_.multipliers());
  }

  /// Returns the size of the last step relative to the result, by kinds of unknowns.
  double size_of_all() const {
    std::array<double, kind_count> step{}, whole{};
    const auto note = [&](int unknown, double change, double value) {
      const auto kind = static_cast<std::size_t>(system_.kind(unknown));
      step[kind] = std::max(step[kind], std::abs(change));
      whole[kind] = std::max(whole[kind], std::abs(value));
    };
    const int n = system_.dofs(), y = system_.first_orders();
    for (int i = 0; i < n; ++i) note(i, step_[i], a_[i]);
    for (int i = 0; i < y; ++i)
      note(n + i, step_[n + i], std::max(std::abs(state_.first_order_rate[i]), std::abs(state_.first_order[i])));
    for (int i = 0; i < system_.multipliers(); ++i) note(n + y + i, step_[n + y + i], state_.multiplier[i]);
    // Kinds without nonzero values are measured by the others: accelerations by the model's length, forces by masses.
    const auto kind_of = [](Kind kind) { return static_cast<std::size_t>(kind); };
    double &translation = whole[kind_of(Kind::translation)], &rotation = whole[kind_of(Kind::rotation)],
           &multiplier = whole[kind_of(Kind::multiplier)];
    // Parts held in place by forces have accelerations of rounding only.
    translation = std::max({translation, rotation * length_, multiplier / saddle_.scale()});
    rotation = std::max(rotation, translation / length_);
    multiplier = std::max(multiplier, translation * saddle_.scale());
    double most = 0;
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      if (step[kind] > 0) most = std::max(most, step[kind] / std::max(whole[kind], std::numeric_limits<double>::min()));
    return most;
  }

  struct Search {
    bool converged = false;
    int determinant_sign = 0;
    int worst = -1;                                   ///< the multiplier with the longest last step
    bool any_positive = false, any_negative = false;  ///< signs of determinants during the search
    void note(int sign) {
      determinant_sign = sign;
      any_positive = any_positive || sign > 0;
      any_negative = any_negative || sign < 0;
    }
    /// Returns whether the determinant had another sign during the search than without forces that depend on reactions.
    bool flips(int without) const { return without > 0 ? any_negative : any_positive; }
  };

  /// Returns whether Newton's method has converged: by the size of its last step, or because rounding (of forces of
  /// stiff parts, of nearly redundant reactions) prevents shorter steps. Other solutions are much farther away.
  /// @param before  size of the previous step
  static bool settled(double size, double before) {
    constexpr double accurate = 1e-11, rounding = 1e-8;
    return size <= accurate || (size <= rounding && size > 0.5 * before);
  }

  /// Searches by Newton's method with the derivatives by multipliers, from the present state. Steps over kinks are
  /// halved if the next one would be longer.
  Search search() {
    constexpr int most = 50;
    Search result;
    double size_before = std::numeric_limits<double>::infinity();
    try {
      evaluate();
      for (int iteration = 0; iteration < most; ++iteration) {
        if (!saddle_.factor_with_reactions(environment_, state_)) {
          result.any_positive = result.any_negative = true;  // the sign is between the two
          return result;
        }
        result.note(saddle_.determinant_sign());
        solve();
        if (!step_.allFinite()) return result;
        step_.tail(system_.multipliers()).cwiseAbs().maxCoeff(&result.worst);
        const VectorX full = step_;
        const State base = state_;
        const VectorX a_base = a_;
        const double before = step_.cwiseAbs().dot(weights());
        for (double part = 1; part > 0.01; part /= 2) {
          state_ = base;
          a_ = a_base;
          step_ = full;
          move(part);
          evaluate();
          solve();
          if (step_.cwiseAbs().dot(weights()) <= (1 - part / 4) * before) break;
        }
        const double size = size_of_all();
        if (settled(size, size_before)) {
          move(1);
          // The branch of the solution may differ from that of the last factors.
          if (saddle_.factor_with_reactions(environment_, state_)) result.note(saddle_.determinant_sign());
          result.converged = true;
          return result;
        }
        size_before = size;
      }
    } catch (const ComputationError&) {
      // a component cannot be evaluated
    }
    return result;
  }

  /// Returns weights by which only multipliers measure the convergence, because the forces depend on them.
  VectorX weights() const {
    VectorX weights = VectorX::Zero(system_.size());
    weights.tail(system_.multipliers()).setOnes();
    return weights;
  }

  /// Iterates by Newton's method for the algebraic unknowns and all unknowns that depend on them.
  /// @param search  search for balances, or nullptr: none
  /// @returns 0 if it has converged, otherwise the number of iterations
  int iterate_for_algebraic(BalanceSearch* search) {
    constexpr int most = 50;
    constexpr double accurate = 1e-9;  // size of the step: the remaining error is its square
    if (search) balance(*search);
    saddle_.factor(environment_, state_);
    solve();
    for (int iteration = 0;; ++iteration) {
      measure();
      const double size = size_of_step();
      if (size <= accurate) {
        move(1);
        return 0;
      }
      if (iteration == most || !std::isfinite(size)) return iteration + 1;
      if (search) {
        move(1);
        balance(*search);
      } else {
        shorten(size);
      }
      saddle_.factor(environment_, state_);
      solve();
    }
  }

  /// Searches for balances. There may be none while the other unknowns have not converged; the state is then used
  /// unchanged.
  void balance(BalanceSearch& search) {
    search.find(environment_, state_);
    evaluate();
  }

  /// Sets the references for steps of the algebraic unknowns: their scales, initial and present values. (From zero,
  /// without a scale, the reference is the step itself.)
  void measure() {
    for (std::size_t j = 0; j < size_.size(); ++j) {
      const int k = system_.algebraic()[j];
      size_[j] = std::max({std::abs(state_.first_order[k]), std::abs(begin_[k]), system_.scale(system_.dofs() + k)});
      if (size_[j] == 0) size_[j] = std::abs(step_[system_.dofs() + k]);
    }
  }

  double size_of_step() {
    double most = 0;
    for (std::size_t j = 0; j < size_.size(); ++j) {
      const int unknown = system_.dofs() + system_.algebraic()[j];
      if (step_[unknown] == 0) continue;
      const double size = std::abs(step_[unknown]) / size_[j];
      if (size <= most) continue;
      most = size;
      worst_ = unknown;
      if (!std::isfinite(size)) break;
    }
    return most;
  }

  /// Moves by a fraction of the step for which the next one, with the same factors, is shorter (P. Deuflhard, Newton
  /// Methods for Nonlinear Problems, 2004, 3.3). Steps are compared because residuals have different units.
  void shorten(double size) {
    const State base = state_;
    const VectorX a = a_, step = step_;
    for (double part = 1; part > 1e-3; part /= 2) {
      state_ = base;
      a_ = a;
      step_ = step;
      move(part);
      try {
        evaluate();
        solve();
      } catch (const ComputationError&) {
        continue;  // a component cannot be evaluated
      }
      if (size_of_step() <= (1 - part / 4) * size) break;
    }
    evaluate();
  }

  /// @param why  reason why a balance was not found, or empty
  [[noreturn]] void throw_unsolved(int iterations, const std::string& why) {
    if (!why.empty()) throw ComputationError(fmt::format("t = {:.6g} s: {}", state_.time, why));
    evaluate();
    throw ComputationError(
        fmt::format("t = {:.6g} s: no value was found for {} that satisfies its equation; {:.2g} {} are left after {} "
                    "of Newton's method",
                    state_.time, system_.unknown_name(worst_), r_[worst_], system_.equation_units(worst_),
                    counted(iterations, "iteration")));
  }

  void check_same(const VectorX& one, const VectorX& other) const {
    double moved = 0;
    for (int i = 0; i < system_.dofs(); ++i)
      if (system_.kind(i) == Kind::translation) moved = std::max(moved, std::abs(a_[i]));
    const double size =
        std::max({one.lpNorm<Eigen::Infinity>(), other.lpNorm<Eigen::Infinity>(), 1e-6 * moved * saddle_.scale()});
    Eigen::Index most = 0;
    if ((one - other).cwiseAbs().maxCoeff(&most) <= 1e-6 * size) return;
    const int multiplier = static_cast<int>(most);
    throw_ambiguous_accelerations(system_, state_.time,
                                  fmt::format("the multiplier {} may be {:.4g} or {:.4g}",
                                              multiplier_name(system_, multiplier), one[most], other[most]),
                                  multiplier);
  }

  const System& system_;
  const Environment& environment_;
  State& state_;
  KktMatrix& saddle_;
  ReadReactions reactions_;
  double length_;
  VectorX known_;  ///< multipliers of the given state
  VectorX v_, a_, r_, step_;
  VectorX begin_;             ///< initial first-order unknowns
  std::vector<double> size_;  ///< for each algebraic unknown
  int worst_ = 0;
};

}  // namespace

void make_accelerations_consistent(const System& system, const Environment& environment, State& state,
                                   KktMatrix& saddle) {
  AccelerationEquations equations(system, environment, state, saddle, AccelerationEquations::From::nothing);
  if (system.reads_reactions())
    equations.solve_with_reactions();
  else if (!system.algebraic().empty())
    equations.solve_for_algebraic();
  else
    return equations.solve_linear();
  saddle.serve_no_more();
}

void continue_accelerations(const System& system, const Environment& environment, State& state, KktMatrix& saddle) {
  if (system.reads_reactions()) {
    AccelerationEquations equations(system, environment, state, saddle, AccelerationEquations::From::state);
    const bool found = equations.continue_with_reactions();
    saddle.serve_no_more();
    if (found) return;
  }
  make_accelerations_consistent(system, environment, state, saddle);
}

void make_accelerations_consistent(const System& system, const Environment& environment, State& state) {
  KktMatrix saddle(system);
  make_accelerations_consistent(system, environment, state, saddle);
}

}  // namespace bielle::mechanism
