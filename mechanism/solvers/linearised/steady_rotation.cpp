#include "mechanism/solvers/linearised/steady_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/linearised/loose_motions.hpp"
#include "mechanism/solvers/linearised/mean_forces.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/newton/newton_matrix.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// The motion of all nodes in steady rotation.
class RotationMotion {
 public:
  RotationMotion(const SteadyRotation& rotation, const TurningPart* part) : rotation_(rotation), part_(part) {}

  double rate() const { return part_ ? std::abs(rotation_.rate) : rotation_.omega.norm(); }
  RotationMotion slower(double factor) const {
    RotationMotion slow = *this;
    slow.rotation_.omega *= factor;
    slow.rotation_.rate *= factor;
    return slow;
  }
  /// Sets the rates and accelerations of nodes, whether they are free or not.
  void set(std::vector<NodeState>& nodes, const State& state) const {
    if (part_) {
      part_->set_motion(rotation_.rate, nodes, state);
      return;
    }
    for (NodeState& node : nodes) {
      node.v = rotation_.omega.cross(node.x - rotation_.through);
      node.a = rotation_.omega.cross(node.v);
      node.Omega = node.R.transpose() * rotation_.omega;
      node.Omegadot.setZero();
    }
  }

 private:
  SteadyRotation rotation_;
  const TurningPart* part_;
};

void turn(const System& system, const RotationMotion& rotation, State& state) {
  State turning = state;
  rotation.set(turning.nodes, state);
  turning.amplitude_rate.setZero();
  turning.amplitude_acceleration.setZero();
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(turning, v, a);
  system.set_rates(state, v, a);
  state.first_order_rate.setZero();
}

/// Newton's method for the equilibrium at one angular velocity, with the safeguards of statics (equilibrium.hpp): the
/// stiffness uses the stress predicted by the last step, and steps are shortened if they rotate a node far or if a
/// component cannot be evaluated.
class RotationEquilibrium {
 public:
  RotationEquilibrium(const System& system, const Environment& environment, const TurningPart* part)
      : system_(system),
        environment_(environment),
        part_(part),
        forces_(system, environment, part),
        linear_(system),
        convergence_(system, tolerances()) {}

  /// @returns whether it was found; otherwise the state is the last iterate
  bool find(const RotationMotion& rotation, const State& from, State& state) {
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
  bool iterate(const RotationMotion& rotation, State& state) {
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
  bool calc_step(const RotationMotion& rotation, const State& state, const State* before, VectorX& r) {
    const int n = system_.dofs() + system_.first_orders();
    forces_.residual(state, r);
    LinearisedEquations equations =
        linearised_equations(system_, state, ModeAxes::turning, forces_.matrices(state, before), r);
    if (part_) equations.K += axis_stiffness(rotation, state, r);
    // At rest, the slowest rate is used.
    const double rate = rotation.rate() > 0 ? rotation.rate() : slowest_rate(equations);
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

  /// Returns the derivatives of the forces with respect to the motion of the axis with its standing node, by
  /// differences.
  LinearisedEquations::Sparse axis_stiffness(const RotationMotion& rotation, const State& state, const VectorX& r) {
    const int n = system_.dofs() + system_.first_orders();
    LinearisedEquations::Sparse stiffness(n, n);
    const Carry* carry = system_.kinematics().carry(part_->base());
    const NodeFreedom& freedom = system_.kinematics().freedom(carry ? carry->carrier : part_->base());
    std::vector<Eigen::Triplet<double>> entries;
    constexpr double angle = 1e-6;
    VectorX changed(system_.size()), v(system_.dofs()), a(system_.dofs());
    for (int j = freedom.begin; j < freedom.begin + freedom.count; ++j) {
      const double h = angle * (system_.kind(j) == Kind::translation ? model_length(state) : 1);
      VectorX dq = VectorX::Zero(system_.dofs());
      dq[j] = h;
      State displaced = state, turned = state;
      system_.displace(displaced, state, dq);
      rotation.set(turned.nodes, displaced);
      system_.get_rates(turned, v, a);
      system_.set_rates(turned, v, a);
      forces_.residual(turned, changed);
      for (int i = 0; i < n; ++i)
        if (changed[i] != r[i]) entries.emplace_back(i, j, (changed[i] - r[i]) / h);
    }
    stiffness.setFromTriplets(entries.begin(), entries.end());
    return stiffness;
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
  bool go(const RotationMotion& rotation, const State& from, double part, State& state) {
    constexpr double least = 0.1;
    const int n = system_.dofs() + system_.first_orders();
    for (VectorX r(system_.size()); part > least / 16; part /= 2) {
      try {
        state = from;
        system_.displace(state, from, part * step_.head(system_.dofs()));
        state.first_order += part * step_.segment(system_.dofs(), system_.first_orders());
        state.multiplier += part * step_.tail(system_.size() - n);
        turn(system_, rotation, state);
        forces_.residual(state, r);
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
    forces_.residual(state, r, &scale);
    linear_.assemble(state, environment_, TangentWeights{1, 0, 0, 0, 1, true}, nullptr);
    convergence_.measure_rounding(linear_, state);
    return convergence_.reached(r, scale);
  }

  /// Methods to hold indifferent motions: by inertia against displacements (hold_loose); or, if this fails, by inertia
  /// and Coriolis forces of a small rate. These separate directions if D(0) is nearly singular on the way, as with
  /// elements that are too long for their tension.
  enum class Hold { displacements, rates };

  const System& system_;
  const Environment& environment_;
  const TurningPart* part_;
  MeanForces forces_;
  NewtonMatrix linear_;
  Convergence convergence_;
  Hold hold_ = Hold::displacements;
  VectorX step_;  ///< (size)
};

/// Throws if some component prevents the rotation.
void check_turns(const System& system, const Environment& environment, const TurningPart* part,
                 const RotationMotion& motion, const State& state) {
  const double rate = motion.rate(), length = model_length(state);
  const std::string turning = part ? "what is behind the joint" : "the mechanism";
  VectorX velocity(system.multipliers()), unused(system.multipliers());
  system.constraint_rates(state, environment, velocity, unused);
  system.for_each_idle(state, [&](int k) { velocity[k] = 0; });
  const VectorX sizes = constraint_sizes(system, environment, state);
  constexpr double agrees = 1e-6;
  for (int k = 0; k < system.multipliers(); ++k)
    if (std::abs(velocity[k]) > agrees * rate * sizes[k] && !(part && part->drives_joint(k)))
      throw ComputationError(fmt::format("{} cannot turn as a whole: {} prevents it ({:.3g} {}/s)", turning,
                                         system.equation_name(system.size() - system.multipliers() + k), velocity[k],
                                         system.equation_units(system.size() - system.multipliers() + k)));
  std::vector<NodeState> wanted = state.nodes;
  motion.set(wanted, state);
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const NodeState& node = state.nodes[k];
    const NodeFreedom& freedom = system.kinematics().freedom(static_cast<int>(k));
    if (freedom.count == 0 || system.kinematics().carry(static_cast<int>(k))) continue;
    const double gap = (node.v - wanted[k].v).norm() / length + (node.Omega - wanted[k].Omega).norm();
    if (gap > agrees * rate)
      throw ComputationError(
          fmt::format("{} cannot turn as a whole: node '{}' is held in directions in which it would have to move",
                      turning, system.model().node(static_cast<int>(k)).name));
  }
}

/// Returns the largest rotation or displacement of a node, relative to the mechanism's size. A large increment may have
/// led to another equilibrium than that of the path.
double farthest_between(const State& a, const State& b) {
  const double length = model_length(a);
  double most = 0;
  for (std::size_t k = 0; k < a.nodes.size(); ++k)
    most = std::max({most, (b.nodes[k].x - a.nodes[k].x).norm() / length,
                     log_so3(Matrix3(a.nodes[k].R.transpose() * b.nodes[k].R)).norm()});
  return most;
}

/// Returns the sentence about a rate at which no equilibrium was found. @param last  the last equilibrium, at its rate
std::string no_equilibrium(double rate, double followed, const State& first, const State& last) {
  std::string text = fmt::format(
      "no equilibrium in steady rotation at {:.6g} rad/s was found; the mechanism was followed up to {:.6g} rad/s",
      rate, followed);
  double farthest = 0;
  for (std::size_t k = 0; k < first.nodes.size(); ++k)
    farthest = std::max(farthest, (last.nodes[k].x - first.nodes[k].x).norm());
  if (farthest > model_length(first))
    text += fmt::format(
        ", where a node is {:.3g} m from its place at the start: centrifugal forces outweigh the stiffness at a rate "
        "near this one (static divergence)",
        farthest);
  return text;
}

}  // namespace

void settle_in_rotation(const System& system, const Environment& environment, const SteadyRotation& rotation,
                        State& state) {
  // The square of the speed is incremented, because inertial forces are proportional to it.
  constexpr double least = 1.0 / 4096, far = 0.15;
  const std::unique_ptr<const TurningPart> turning =
      rotation.joint ? std::make_unique<const TurningPart>(system, environment, state, *rotation.joint) : nullptr;
  const RotationMotion motion(rotation, turning.get());
  RotationEquilibrium equilibrium(system, environment, turning.get());
  const State first = state;
  double made = 0, part = 1;
  while (made < 1) {
    const double end = std::min(1.0, made + part);
    State trial = state;
    const bool good = equilibrium.find(motion.slower(std::sqrt(end)), state, trial);
    if (!good || (part > 16 * least && farthest_between(state, trial) > far)) {
      part /= 2;
      if (part < least)
        throw ComputationError(no_equilibrium(motion.rate(), std::sqrt(made) * motion.rate(), first, state));
      continue;
    }
    state = trial;
    made = end;
    part *= 2;
  }
  check_turns(system, environment, turning.get(), motion, state);
}

}  // namespace bielle::mechanism
