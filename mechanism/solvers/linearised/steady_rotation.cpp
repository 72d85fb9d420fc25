#include "mechanism/solvers/linearised/steady_rotation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/newton/newton_matrix.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

void turn(const System& system, const SteadyRotation& rotation, State& state) {
  State turning = state;
  for (NodeState& node : turning.nodes) {
    node.v = rotation.omega.cross(node.x - rotation.through);
    node.a = rotation.omega.cross(node.v);
    node.Omega = node.R.transpose() * rotation.omega;
    node.Omegadot.setZero();
  }
  turning.amplitude_rate.setZero();
  turning.amplitude_acceleration.setZero();
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(turning, v, a);
  system.set_rates(state, v, a);
  state.first_order_rate.setZero();
}

/// Indifferent motions (a free shaft) are held in place: a small inertia resists displacements. Rates must not be
/// included, or the Coriolis forces of an eccentric rotor that moves outwards would rotate its free shaft far. Unknowns
/// without inertia are held as strongly as the others.
void hold_loose(double rate, LinearisedEquations& equations) {
  constexpr double little = 1e-6;  // fraction of centrifugal forces
  VectorX sum = VectorX::Zero(2), count = sum;
  const VectorX inertia = equations.M.diagonal();
  const auto kind = [&](int i) { return equations.turns[static_cast<std::size_t>(i)] != 0 ? 1 : 0; };
  for (int i = 0; i < equations.dofs; ++i) {
    sum[kind(i)] += inertia[i];
    count[kind(i)] += inertia[i] > 0 ? 1 : 0;
  }
  VectorX missing = VectorX::Zero(equations.unknowns());
  for (int i = 0; i < equations.dofs; ++i)
    if (!(inertia[i] > 0) && count[kind(i)] > 0) missing[i] = sum[kind(i)] / count[kind(i)];
  equations.K += little * rate * rate * (equations.M + LinearisedEquations::Sparse(missing.asDiagonal()));
}

/// Newton's method for the equilibrium at one angular velocity, with the safeguards of statics (equilibrium.hpp): the
/// stiffness uses the stress predicted by the last step, and steps are shortened if they rotate a node far or if a
/// component cannot be evaluated.
class RotationEquilibrium {
 public:
  RotationEquilibrium(const System& system, const Environment& environment)
      : system_(system), environment_(environment), linear_(system), convergence_(system, tolerances()) {}

  /// @returns whether it was found; otherwise the state is the last iterate
  bool find(const SteadyRotation& rotation, const State& from, State& state) {
    for (const Hold hold : {Hold::displacements, Hold::rates}) {
      hold_ = hold;
      state = from;
      try {
        if (iterate(rotation, state)) return true;
      } catch (const ComputationError&) {
        continue;  // a distant iterate at which a component cannot be evaluated
      }
    }
    return false;
  }

 private:
  bool iterate(const SteadyRotation& rotation, State& state) {
    constexpr int most = 40;
    constexpr double small = 1e-10;    // convergence limit relative to the mechanism's size, and [rad]
    constexpr double balanced = 1e-6;  // size of a step after which the residual is only rounding
    bool stepped = false, found = false;
    State before = state;
    VectorX r(system_.size());
    for (int iteration = 0; iteration < most; ++iteration) {
      turn(system_, rotation, state);
      if (!calc_step(rotation, state, stepped ? &before : nullptr, r)) return false;
      const double size = size_of(state);
      if (!std::isfinite(size)) return false;
      before = state;
      stepped = true;
      if (!go(rotation, before, shortened(state), state)) return false;
      if (found) {
        turn(system_, rotation, state);
        return true;
      }
      // One more step leaves only rounding: rigid motions are identified by the residual of an equilibrium.
      found = size < small || (size < balanced && reached(state));
    }
    return false;
  }

  static NewtonOptions tolerances() {
    NewtonOptions options;
    options.tolerance = 1e-12;
    return options;
  }

  /// @returns false if the equations are singular
  bool calc_step(const SteadyRotation& rotation, const State& state, const State* before, VectorX& r) {
    const int n = system_.dofs() + system_.first_orders();
    system_.residual(state, environment_, r);
    Environment predicted = environment_;
    predicted.before = before;
    LinearisedEquations equations = linearised_equations(system_, predicted, state, ModeAxes::turning);
    const double rate = rotation.omega.norm();
    if (hold_ == Hold::displacements) hold_loose(rate, equations);
    const ShiftedOperator D(equations, hold_ == Hold::displacements ? 0 : 1e-3 * rate);
    if (!D.regular()) return false;
    VectorX right(n + equations.constraints());
    right.head(n) = -r.head(n);
    for (int k = 0; k < equations.constraints(); ++k)
      right[n + k] = -r[n + equations.multiplier[static_cast<std::size_t>(k)]];
    const VectorX found = D.solve(right.cast<std::complex<double>>()).real();
    step_ = VectorX::Zero(system_.size());
    step_.head(n) = found.head(n);
    for (int k = 0; k < equations.constraints(); ++k)
      step_[n + equations.multiplier[static_cast<std::size_t>(k)]] = found[n + k];
    return step_.allFinite();
  }

  /// Returns the largest displacement relative to the mechanism's size, or rotation [rad].
  double size_of(const State& state) const {
    const double length = model_length(state);
    double size = 0;
    for (int i = 0; i < system_.dofs(); ++i)
      if (system_.kind(i) != Kind::amplitude)
        size = std::max(size, std::abs(step_[i]) / (system_.kind(i) == Kind::translation ? length : 1));
    return size;
  }
  double shortened(const State& state) const {
    constexpr double longest = 2;  // rotation [rad], and relative to the mechanism's size
    const double size = size_of(state);
    return size > longest ? longest / size : 1;
  }

  /// Applies a fraction of the step, or less if a component cannot be evaluated. @returns false if none is possible
  bool go(const SteadyRotation& rotation, const State& from, double part, State& state) {
    constexpr double least = 0.1;
    const int n = system_.dofs() + system_.first_orders();
    for (VectorX r(system_.size()); part > least / 16; part /= 2) {
      try {
        state = from;
        system_.displace(state, from, part * step_.head(system_.dofs()));
        state.first_order += part * step_.segment(system_.dofs(), system_.first_orders());
        state.multiplier += part * step_.tail(system_.size() - n);
        turn(system_, rotation, state);
        system_.residual(state, environment_, r);
        if (r.allFinite()) return true;
      } catch (const ComputationError&) {
        continue;
      }
    }
    return false;
  }

  bool reached(const State& state) {
    VectorX r(system_.size());
    ResidualScale scale;
    system_.residual(state, environment_, r, &scale);
    linear_.assemble(state, environment_, TangentWeights{1, 0, 0, 0, 1, true}, nullptr);
    convergence_.measure_rounding(linear_, state);
    return convergence_.reached(r, scale);
  }

  /// Methods to hold indifferent motions: by inertia against displacements (hold_loose); or, if this fails, by inertia
  /// and Coriolis forces of a small rate. These separate directions if D(0) is nearly singular on the way, as with
  /// elements that are too long for their tension.
  enum class Hold { displacements, rates };

  const System& system_;
  Environment environment_;
  NewtonMatrix linear_;
  Convergence convergence_;
  Hold hold_ = Hold::displacements;
  VectorX step_;  ///< (size)
};

/// Throws if some component prevents the rotation of the whole mechanism.
void check_turns(const System& system, const Environment& environment, const SteadyRotation& rotation,
                 const State& state) {
  const double rate = rotation.omega.norm(), length = model_length(state);
  VectorX velocity(system.multipliers()), unused(system.multipliers());
  system.constraint_rates(state, environment, velocity, unused);
  system.for_each_idle(state, [&](int k) { velocity[k] = 0; });
  const VectorX sizes = constraint_sizes(system, environment, state);
  constexpr double agrees = 1e-6;
  for (int k = 0; k < system.multipliers(); ++k)
    if (std::abs(velocity[k]) > agrees * rate * sizes[k])
      throw ComputationError(fmt::format("the mechanism cannot turn as a whole: {} does not let it ({:.3g} {}/s)",
                                         system.equation_name(system.size() - system.multipliers() + k), velocity[k],
                                         system.equation_units(system.size() - system.multipliers() + k)));
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const NodeState& node = state.nodes[k];
    const NodeFreedom& freedom = system.kinematics().freedom(static_cast<int>(k));
    if (freedom.count == 0 || system.kinematics().carry(static_cast<int>(k))) continue;
    const double gap = (node.v - rotation.omega.cross(node.x - rotation.through)).norm() / length +
                       (node.R * node.Omega - rotation.omega).norm();
    if (gap > agrees * rate)
      throw ComputationError(fmt::format(
          "the mechanism cannot turn as a whole: node '{}' is held in directions in which it would have to move",
          system.model().node(static_cast<int>(k)).name));
  }
}

/// Largest rotation or displacement of a node relative to the mechanism's size: a large increment may have led to
/// another equilibrium than that of the path.
double farthest_between(const State& a, const State& b) {
  const double length = model_length(a);
  double most = 0;
  for (std::size_t k = 0; k < a.nodes.size(); ++k)
    most = std::max({most, (b.nodes[k].x - a.nodes[k].x).norm() / length,
                     log_so3(Matrix3(a.nodes[k].R.transpose() * b.nodes[k].R)).norm()});
  return most;
}

}  // namespace

void settle_in_rotation(const System& system, const Environment& environment, const SteadyRotation& rotation,
                        State& state) {
  // The square of the speed is incremented, because inertial forces are proportional to it.
  constexpr double least = 1.0 / 4096, far = 0.15;
  RotationEquilibrium equilibrium(system, environment);
  double made = 0, part = 1;
  while (made < 1) {
    const double end = std::min(1.0, made + part);
    SteadyRotation slower = rotation;
    slower.omega *= std::sqrt(end);
    State trial = state;
    const bool good = equilibrium.find(slower, state, trial);
    if (!good || (part > 16 * least && farthest_between(state, trial) > far)) {
      part /= 2;
      if (part < least)
        throw ComputationError(
            fmt::format("no equilibrium in steady rotation at {:.6g} rad/s was found; the "
                        "mechanism was followed up to {:.6g} rad/s",
                        rotation.omega.norm(), std::sqrt(made) * rotation.omega.norm()));
      continue;
    }
    state = trial;
    made = end;
    part *= 2;
  }
  check_turns(system, environment, rotation, state);
}

}  // namespace bielle::mechanism
