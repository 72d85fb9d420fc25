#include "mechanism/solvers/statics/quasi_static_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "mechanism/solvers/start/continuous_motion.hpp"
#include "mechanism/solvers/statics/node_motion.hpp"

namespace bielle::mechanism {
namespace {

Environment at_rest_in(Environment environment) {
  environment.statics = true;
  return environment;
}

/// The largest displacement of a node, relative to the extent, or turn [rad].
double distance(const State& from, const State& to) {
  const double length = std::max(model_extent(to), 1e-30);
  double largest = 0;
  for (const NodeMotion& motion : motions_between(from, to))
    largest = std::max({largest, motion.displacement.norm() / length, motion.turn.norm()});
  return largest;
}

}  // namespace

QuasiStaticMotion::QuasiStaticMotion(const System& system, const Environment& environment, double step)
    : system_(system),
      environment_(environment),
      statics_(at_rest_in(environment)),
      ramp_(system, statics_, Loaded{1, 1}),
      path_equilibrium_(ramp_, NewtonOptions()),
      equilibrium_(ramp_, NewtonOptions()),
      tangent_(system),
      saddle_(system),
      kinks_(system.break_points()),
      step_(step),
      v_(VectorX::Zero(system.dofs())),
      a_(VectorX::Zero(system.dofs())),
      lambda_rate_(VectorX::Zero(system.multipliers())) {}

void QuasiStaticMotion::begin(State& state) {
  path_ = state;
  path_equilibrium_.look_for_loose(1, path_);
  equilibrium_.look_for_loose(1, path_);
  tangent_.look_for_loose(path_, statics_);
  find_path(path_, state.time);
  find_rates();
  state = path_;
  load_by_inertia(state);
}

State QuasiStaticMotion::position(const State& from, double time) {
  State next = predicted(system_, from, time);
  find_path(path_, time);
  find_rates();
  load_by_inertia(next);
  return next;
}

void QuasiStaticMotion::find_path(const State& from, double time) {
  State next = from;
  const double h = time - from.time;
  next.time = time;
  system_.displace(next, from, h * v_ + 0.5 * h * h * a_);
  system_.set_rates(next, VectorX::Zero(system_.dofs()), VectorX::Zero(system_.dofs()));
  if (path_equilibrium_.find(1, next) < 0 && path_equilibrium_.search(1, next) < 0)
    throw ComputationError(path_equilibrium_.why());
  path_ = std::move(next);
}

/// The residual at rest a time after that of the path, a part of the way along its rates. Time stands still where no
/// support moves: drives act by their constraints, and what loads change by themselves deforms without inertia.
VectorX QuasiStaticMotion::at_rest(double after, double part) const {
  State moved = path_;
  if (supports_move_) moved.time = path_.time + after;
  system_.displace(moved, path_, part * after * v_);
  moved.multiplier += part * after * lambda_rate_;
  VectorX r(system_.size());
  residual_at_rest(system_, statics_, moved, r);
  return r;
}

/// Whether nodes are moved by their supports about the path's time.
bool QuasiStaticMotion::do_supports_move() const {
  State moved = path_;
  for (const double after : {-step_, 0.3 * step_, step_}) {
    moved.time = path_.time + after;
    system_.displace(moved, path_, VectorX::Zero(system_.dofs()));
    for (std::size_t i = 0; i < moved.nodes.size(); ++i)
      if (moved.nodes[i].x != path_.nodes[i].x || moved.nodes[i].R != path_.nodes[i].R) return true;
  }
  return false;
}

/// The first derivative of a residual that moves along a part of the path's rates, or the second where the first
/// vanishes. If a kink of a support's motion is too near, the differences lie on the side away from it alone.
VectorX QuasiStaticMotion::derivative(double part, int order) const {
  constexpr double turn = 0.005;  // [rad], or of the extent: differences err by its powers, rounding by its square
  const double length = std::max(model_extent(path_), 1e-30);
  double speed = 0;
  for (int i = 0; i < system_.dofs(); ++i)
    speed = std::max(speed, std::abs(v_[i]) / (system_.kind(i) == Kind::translation ? length : 1));
  double h = std::min(turn / std::max(speed, 1e-300), supports_move_ ? 0.5 * step_ : 1e3 * step_);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double before = infinity, after = infinity;  // to the nearest kinks; one at this time is left behind
  if (supports_move_)
    for (const double kink : kinks_) {
      double& distance = kink > path_.time ? after : before;
      distance = std::min(distance, std::abs(kink - path_.time));
    }
  const VectorX r0 = at_rest(0, part);
  const auto r = [&](int steps) { return VectorX(at_rest(steps * h, part) - r0); };
  if (std::min(before, after) >= 2 * h)
    return order == 1 ? VectorX((8 * (r(1) - r(-1)) - r(2) + r(-2)) / (12 * h))
                      : VectorX((16 * (r(1) + r(-1)) - r(2) - r(-2)) / (12 * h * h));
  h = after < before ? -std::min(h, 0.3 * before) : std::min(h, 0.3 * after);
  return order == 1 ? VectorX((3 * r(1) - 1.5 * r(2) + r(3) / 3) / h)
                    : VectorX((6 * r(1) - 1.5 * r(2) + 2.0 / 9 * r(3)) / (h * h));
}

/// Sets the rows of constraints that are in the equations; those of the others vanish.
void QuasiStaticMotion::put_constraints(const State& state, const VectorX& rows, VectorX& r) const {
  r.tail(rows.size()) = rows;
  system_.for_each_idle(state, [&](int k) { r[system_.size() - system_.multipliers() + k] = 0; });
}

void QuasiStaticMotion::find_rates() {
  const int dofs = system_.dofs(), multipliers = system_.multipliers();
  tangent_.factor(path_, statics_);
  supports_move_ = do_supports_move();
  VectorX r(system_.size()), solution(system_.size()), velocity(multipliers), acceleration(multipliers);
  const VectorX zero = VectorX::Zero(dofs);
  State moving = path_;
  system_.set_rates(moving, zero, zero);
  system_.constraint_rates(moving, environment_, velocity, acceleration);
  r = derivative(0, 1);
  put_constraints(path_, velocity, r);
  tangent_.solve(r, solution);
  v_ = solution.head(dofs);
  lambda_rate_ = solution.tail(multipliers);
  system_.set_rates(moving, v_, zero);
  system_.constraint_rates(moving, environment_, velocity, acceleration);
  r = derivative(1, 2);
  put_constraints(path_, acceleration, r);
  tangent_.solve(r, solution);
  a_ = solution.head(dofs);
}

/// The inertia forces are what velocities and accelerations add to the residual (dofs).
VectorX QuasiStaticMotion::inertia_forces(const State& state) const {
  VectorX moving(system_.size()), resting(system_.size());
  system_.residual(state, environment_, moving);
  State still = state;
  system_.set_rates(still, VectorX::Zero(system_.dofs()), VectorX::Zero(system_.dofs()));
  residual_at_rest(system_, statics_, still, resting);
  return (moving - resting).head(system_.dofs());
}

/// Gives a state the path's rates, changed as little as the constraints of its deformed position ask for.
void QuasiStaticMotion::take_rates(State& state) {
  const int multipliers = system_.multipliers();
  system_.set_rates(state, v_, a_);
  if (multipliers == 0) return;
  StartReport unused;
  make_velocities_consistent(system_, environment_, state, unused, saddle_);
  VectorX v(system_.dofs()), a(system_.dofs()), velocity(multipliers), acceleration(multipliers);
  system_.constraint_rates(state, environment_, velocity, acceleration);
  VectorX r = VectorX::Zero(system_.size()), change(system_.size());
  put_constraints(state, acceleration, r);
  saddle_.solve(r, change);
  system_.get_rates(state, v, a);
  system_.set_rates(state, v, a + change.head(system_.dofs()));
}

void QuasiStaticMotion::load_by_inertia(State& state) {
  constexpr int most = 60;
  constexpr double settled = 1e-9;  // [rad], or of the extent: so far inertia forces are not known
  for (int k = 0; k < most; ++k) {
    take_rates(state);
    equilibrium_.push(-inertia_forces(state));
    State next = state;
    system_.set_rates(next, VectorX::Zero(system_.dofs()), VectorX::Zero(system_.dofs()));
    if (equilibrium_.find(1, next) < 0 && equilibrium_.search(1, next) < 0) throw ComputationError(equilibrium_.why());
    const double change = distance(state, next);
    state = std::move(next);
    if (k > 0 && change <= settled) return take_rates(state);
  }
  throw ComputationError(
      "the deformation under inertia forces does not settle: the motion is too fast for elastic parts that follow in "
      "equilibrium; take a dynamic analysis");
}

void QuasiStaticMotion::note_left_out(const State& state) {
  std::vector<Vector3> deformation;
  for (std::size_t i = 0; i < state.nodes.size(); ++i) deformation.push_back(state.nodes[i].x - path_.nodes[i].x);
  deformations_.push_back(std::move(deformation));
  times_.push_back(state.time);
  const std::size_t n = times_.size();
  if (n < 3) return;
  const double h = times_[n - 1] - times_[n - 2], before = times_[n - 2] - times_[n - 3];
  // A difference across a kink in the law of a drive tells of the kink alone.
  const bool smooth = std::none_of(kinks_.begin(), kinks_.end(),
                                   [&](double kink) { return kink > times_[n - 3] - h && kink < times_[n - 1] + h; });
  if (smooth && std::abs(h - before) <= 1e-6 * h) {
    double left_out = 0, motion = 0;
    for (std::size_t i = 0; i < state.nodes.size(); ++i) {
      left_out =
          std::max(left_out, (deformations_[n - 1][i] - 2 * deformations_[n - 2][i] + deformations_[n - 3][i]).norm());
      motion = std::max(motion, state.nodes[i].a.norm());
    }
    largest_motion_ = std::max(largest_motion_, motion);
    largest_left_out_ = std::max(largest_left_out_, left_out / (h * h));
  }
  deformations_.erase(deformations_.begin());
  times_.erase(times_.begin());
}

}  // namespace bielle::mechanism
