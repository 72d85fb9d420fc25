#include "mechanism/solvers/statics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "mechanism/solvers/model_length.hpp"
#include "mechanism/solvers/redundancy.hpp"

namespace bielle::mechanism {
namespace {

/// Newton's method at a fixed load.
class Equilibrium {
 public:
  Equilibrium(const System& system, const NewtonOptions& options)
      : system_(system),
        options_(options),
        linear_(system),
        convergence_(system, options),
        r_(system.size()),
        delta_(system.size()) {}

  /// Returns the iterations, or -1 with the state as it was. @throws ComputationError from components and from a
  /// singular tangent
  int find(const Environment& environment, State& state) {
    const State start = state;
    evaluate(environment, state);
    for (int iteration = 0;; ++iteration) {
      if (iteration > 0 && convergence_.reached(r_, scale_)) return iteration;
      if (iteration == options_.iterations || !r_.allFinite()) {
        convergence_.reached(r_, scale_);
        state = start;
        return -1;
      }
      improve(environment, state);
    }
  }
  /// Goes down to an equilibrium from afar, also where nothing but inertia resists at first (an arm that is to hang):
  /// pseudo-transient continuation, (K + M/tau^2) dq = -r with tau growing as the residual falls, from steps of a tenth
  /// of the mechanism's size on (C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508). Returns as `find`.
  int relax(const Environment& environment, State& state) {
    constexpr int most_iterations = 300;
    const State start = state;
    evaluate(environment, state);
    double tau_squared = first_tau_squared(environment, state);
    for (int iteration = 0; iteration < most_iterations && r_.allFinite(); ++iteration) {
      if (iteration > 0 && convergence_.reached(r_, scale_)) return iteration;
      linear_.factor(state, environment, TangentWeights{1, 0, 1 / tau_squared, 0, 1, true}, nullptr);
      convergence_.measure_rounding(linear_, state);
      convergence_.measure_by(scale_);
      const double before = convergence_.size_of(r_);
      linear_.solve(r_, delta_);
      if (const double excess = extent(state) / longest; excess > 1) {
        tau_squared /= 2 * excess;
        continue;
      }
      const State base = state;
      move(state, base, 1);
      evaluate(environment, state);
      tau_squared *= std::clamp(before / convergence_.size_of(r_), 1.0, 10.0);
    }
    state = start;
    return -1;
  }
  const Convergence& convergence() const { return convergence_; }

 private:
  static constexpr double longest = 0.3;  ///< step of `relax`: of the mechanism's size, or [rad]

  /// The last solution's largest turn [rad], or displacement beside the mechanism's size.
  double extent(const State& state) const {
    double most = 0;
    for (int i = 0; i < system_.dofs(); ++i) {
      if (system_.kind(i) == Kind::rotation) most = std::max(most, std::abs(delta_[i]));
      if (system_.kind(i) == Kind::translation) most = std::max(most, std::abs(delta_[i]) / model_length(state));
    }
    return most;
  }

  /// In which the accelerations of rest lead through a part of `longest`.
  double first_tau_squared(const Environment& environment, const State& state) {
    State released = state;
    make_accelerations_consistent(system_, environment, released);
    VectorX unused(system_.dofs());
    system_.get_rates(released, unused, delta_.head(system_.dofs()));
    const double rate = extent(state);
    return rate > 0 ? 0.3 * longest / rate : 1;
  }

  void move(State& state, const State& base, double part) const {
    system_.displace(state, base, part * delta_.head(system_.dofs()));
    state.first_order = base.first_order + part * delta_.segment(system_.dofs(), system_.first_orders());
    state.multiplier = base.multiplier + part * delta_.tail(system_.multipliers());
  }

  void evaluate(const Environment& environment, const State& state) {
    system_.residual(state, environment, r_, &scale_);
    // Nothing moves: what relates velocities keeps things where they are.
    const int first = system_.size() - system_.multipliers();
    for (int i = 0; i < system_.multipliers(); ++i)
      if (system_.constraint_kind(i) == ConstraintKind::nonholonomic) r_[first + i] = 0;
  }

  void improve(const Environment& environment, State& state) {
    TangentWeights weights;
    weights.acceleration_level = true;
    linear_.factor(state, environment, weights, nullptr);
    convergence_.measure_rounding(linear_, state);
    convergence_.measure_by(scale_);
    const double before = convergence_.size_of(r_);
    linear_.solve(r_, delta_);
    const State base = state;
    const auto size_at = [&](double part) {
      move(state, base, part);
      evaluate(environment, state);
      return convergence_.size_of(r_);
    };
    const auto smaller = [&](double part) {
      try {
        return size_at(part) <= before;
      } catch (const ComputationError&) {
        return false;  // refused by a component
      }
    };
    for (double part = 1; options_.line_search && part > 0.1; part /= 2)
      if (smaller(part)) return;
    size_at(1);  // Newton's method may have to pass over a hill
  }

  const System& system_;
  NewtonOptions options_;
  LinearStep linear_;
  Convergence convergence_;
  VectorX r_, delta_;
  ResidualScale scale_;
};

}  // namespace

void solve_statics(const System& system, const Environment& environment, int steps, const NewtonOptions& options,
                   State& state, const std::function<void(const State&, double, int)>& record) {
  const VectorX zero = VectorX::Zero(system.dofs());
  system.set_rates(state, zero, zero);
  state.first_order_rate.setZero();
  Equilibrium equilibrium(system, options);
  const double first_increment = 1.0 / steps, least_increment = first_increment / 1024;
  double factor = 0, increment = first_increment;
  while (factor < 1) {
    const double target = factor + increment > 1 - 1e-12 ? 1 : factor + increment;
    Environment loaded = environment;
    loaded.load_factor = target;
    loaded.gravity = target * environment.gravity;
    // A component that refuses a wild iterate (a beam whose ends turn too far) makes the attempt fail, not the
    // analysis.
    std::string refusal;
    int iterations = -1;
    const State before = state;
    try {
      iterations = equilibrium.find(loaded, state);
    } catch (const ComputationError& error) {
      refusal = error.what();
      state = before;
    }
    if (iterations < 0) {
      increment /= 2;
      if (increment < least_increment && !refusal.empty()) throw ComputationError(refusal);
      if (increment < least_increment)
        throw ComputationError(fmt::format(
            "statics: Newton did not converge at load factor {:.6g} (increment {:.3g}); largest residual: {}", target,
            increment * 2, equilibrium.convergence().worst()));
      continue;
    }
    check_set_aside(system, loaded, state);
    factor = target;
    system.accept(state, loaded);
    if (record) record(state, factor, iterations);
    if (iterations <= 5) increment = std::min(first_increment, 2 * increment);
  }
}

namespace {

/// The unknown that moves most where nothing resists; none where everything resists.
std::optional<int> loose_unknown(const System& system, const Environment& environment, const State& state) {
  LinearStep linear(system);
  TangentWeights weights;
  weights.acceleration_level = true;
  if (!linear.try_factor(state, environment, weights, nullptr)) return linear.singular_unknown();
  if (!linear.nearly_singular()) return {};
  // A solution for any forces lies along what is loose.
  VectorX motion(system.size());
  linear.solve(VectorX::LinSpaced(system.size(), 1, 2), motion);
  Eigen::Index most = 0;
  motion.head(system.dofs()).cwiseAbs().maxCoeff(&most);
  return static_cast<int>(most);
}

void relax(const System& system, const Environment& environment, const NewtonOptions& options, State& state) {
  const VectorX zero = VectorX::Zero(system.dofs());
  system.set_rates(state, zero, zero);
  Equilibrium equilibrium(system, options);
  std::string why;
  try {
    if (equilibrium.relax(environment, state) < 0) why = "largest residual: " + equilibrium.convergence().worst();
  } catch (const ComputationError& error) {
    why = error.what();
  }
  if (!why.empty())
    throw ComputationError(
        fmt::format("static equilibrium at the start: none was found (what nothing holds has none); {}", why));
  check_set_aside(system, environment, state);
  system.accept(state, environment);
}

}  // namespace

void settle(const System& system, const Environment& of_motion, const NewtonOptions& options, State& state,
            StartReport& report) {
  Environment environment = of_motion;
  environment.statics = true;
  assemble_positions(system, environment, state, report);
  VectorX v(system.dofs()), unused(system.dofs());
  system.get_rates(state, v, unused);
  const State assembled = state;
  try {
    solve_statics(system, environment, 1, options, state);
  } catch (const ComputationError&) {
    state = assembled;
    relax(system, environment, options, state);
  }
  if (const auto loose = loose_unknown(system, environment, state))
    throw ComputationError(fmt::format("static equilibrium at the start: it is not unique: {} meets no resistance",
                                       *loose >= 0 ? system.unknown_name(*loose) : "an unknown"));
  system.set_rates(state, v, VectorX::Zero(system.dofs()));
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const double distance = (state.nodes[i].x - assembled.nodes[i].x).norm();
    if (distance <= report.settled) continue;
    report.settled = distance;
    report.settled_node = system.model().node(static_cast<int>(i)).name;
  }
}

}  // namespace bielle::mechanism
