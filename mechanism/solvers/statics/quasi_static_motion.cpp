#include "mechanism/solvers/statics/quasi_static_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/continuous_motion.hpp"
#include "mechanism/solvers/statics/fixed_point.hpp"
#include "mechanism/solvers/statics/node_motion.hpp"

namespace bielle::mechanism {
namespace {

Environment at_rest_in(Environment environment) {
  environment.statics = true;
  return environment;
}

/// Returns the largest displacement of a node relative to the extent, or its rotation [rad].
double distance(const State& from, const State& to) {
  const double length = std::max(model_extent(to), 1e-30);
  double largest = 0;
  for (const NodeMotion& motion : motions_between(from, to))
    largest = std::max({largest, motion.displacement.norm() / length, motion.turn.norm()});
  return largest;
}

}  // namespace

QuasiStaticMotion::QuasiStaticMotion(const System& system, const Environment& environment, const SoughtEfforts& efforts,
                                     double step)
    : system_(system),
      efforts_(efforts),
      environment_(environment),
      statics_(at_rest_in(environment)),
      ramp_(system, statics_, Loaded{1, 1}),
      path_efforts_(efforts),
      efforts_at_rest_(efforts),
      path_equilibrium_(ramp_, NewtonOptions(), efforts.any() ? &path_efforts_ : nullptr),
      equilibrium_(ramp_, NewtonOptions(), efforts.any() ? &efforts_at_rest_ : nullptr),
      tangent_(system),
      kinks_(system.break_points()),
      step_(step),
      v_(VectorX::Zero(system.dofs())),
      a_(VectorX::Zero(system.dofs())),
      lambda_rate_(VectorX::Zero(system.multipliers())),
      effort_rate_(VectorX::Zero(efforts.count())) {}

void QuasiStaticMotion::begin(State& state) {
  path_ = at_standstill(state);
  path_equilibrium_.look_for_loose(1, path_);
  equilibrium_.look_for_loose(1, path_);
  tangent_.look_for_loose(path_, statics_);
  find_path(path_, state.time);
  f_ = VectorX::Zero(system_.dofs());
  support_ = MatrixX::Zero(6, static_cast<Eigen::Index>(efforts_.nodes().size()));
  state = path_;
  find_rates(state);
  load_by_inertia(state);
}

State QuasiStaticMotion::position(const State& from, double time) {
  State next = predicted(system_, from, time);
  find_path(path_, time);
  system_.get_rates(next, v_, a_);
  load_by_inertia(next);
  return next;
}

/// Returns the state with zero velocities and accelerations, including those of moved nodes.
State QuasiStaticMotion::at_standstill(const State& state) const {
  State still = state;
  ramp_.set_off(still);
  return still;
}

void QuasiStaticMotion::equilibrate(Equilibrium& equilibrium, State& state) const {
  state = at_standstill(state);
  if (equilibrium.find(1, state) < 0 && equilibrium.search(1, state) < 0) throw ComputationError(equilibrium.why());
}

void QuasiStaticMotion::find_path(const State& from, double time) {
  State next = from;
  const double h = time - from.time;
  next.time = time;
  system_.displace(next, from, h * v_ + 0.5 * h * h * a_);
  equilibrate(path_equilibrium_, next);
  path_ = std::move(next);
}

/// Computes the residual at rest for the forces f of a state in equilibrium, a time `after` that state, and after a
/// fraction of the motion along the rates. Time does not advance if no support moves, because drives act by their
/// constraints, and explicit changes of loads cause deformations without inertia.
QuasiStaticMotion::Extended QuasiStaticMotion::at_rest(const State& still, double after, double part) const {
  const double way = part * after, half_square = 0.5 * after * after;
  State moved = still;
  if (supports_move_) moved.time = still.time + after;
  system_.displace(moved, still, way * v_);
  moved.multiplier += way * lambda_rate_;
  efforts_.set(moved, efforts_.values(still) + way * effort_rate_);
  Extended r(system_.size() + efforts_.count());
  residual_at_rest(system_, statics_, moved, r.head(system_.size()));
  r.head(system_.dofs()) += f_ + after * f1_ + half_square * f2_;
  if (efforts_.any())
    r.tail(efforts_.count()) = efforts_.along(
        moved, efforts_.reactions(statics_, moved) + support_ + after * support1_ + half_square * support2_);
  return r;
}

/// Returns whether supports move nodes near a state's time.
bool QuasiStaticMotion::do_supports_move(const State& still) const {
  State moved = still;
  for (const double after : {-step_, 0.3 * step_, step_}) {
    moved.time = still.time + after;
    system_.displace(moved, still, VectorX::Zero(system_.dofs()));
    for (std::size_t i = 0; i < moved.nodes.size(); ++i)
      if (moved.nodes[i].x != still.nodes[i].x || moved.nodes[i].R != still.nodes[i].R) return true;
  }
  return false;
}

/// Computes the first derivative of a residual that moves along a fraction of the path's rates, or the second if the
/// first is zero. If a kink of a support's motion is too near, the differences are only taken on the side away from it.
QuasiStaticMotion::Extended QuasiStaticMotion::derivative(const State& still, double part, int order) const {
  constexpr double turn = 0.005;  // [rad], or relative to the extent: a balance of truncation and rounding errors
  const double length = std::max(model_extent(still), 1e-30);
  double speed = 0;
  for (int i = 0; i < system_.dofs(); ++i)
    speed = std::max(speed, std::abs(v_[i]) / (system_.kind(i) == Kind::translation ? length : 1));
  double h = std::min(turn / std::max(speed, 1e-300), supports_move_ ? 0.5 * step_ : 1e3 * step_);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double before = infinity, after = infinity;  // time to the nearest kinks; one at this time is ignored
  if (supports_move_)
    for (const double kink : kinks_) {
      double& distance = kink > still.time ? after : before;
      distance = std::min(distance, std::abs(kink - still.time));
    }
  const Extended r0 = at_rest(still, 0, part);
  const auto r = [&](int steps) { return Extended(at_rest(still, steps * h, part) - r0); };
  if (std::min(before, after) >= 2 * h)
    return order == 1 ? Extended((8 * (r(1) - r(-1)) - r(2) + r(-2)) / (12 * h))
                      : Extended((16 * (r(1) + r(-1)) - r(2) - r(-2)) / (12 * h * h));
  h = after < before ? -std::min(h, 0.3 * before) : std::min(h, 0.3 * after);
  return order == 1 ? Extended((3 * r(1) - 1.5 * r(2) + r(3) / 3) / h)
                    : Extended((6 * r(1) - 1.5 * r(2) + 2.0 / 9 * r(3)) / (h * h));
}

/// Computes f' and f'' of forces that are constant in the axes of nodes, which rotate like those of a state.
void QuasiStaticMotion::follow(const State& state) {
  f1_ = f2_ = VectorX::Zero(system_.dofs());
  support1_ = support2_ = MatrixX::Zero(6, support_.cols());
  const auto turned = [&](int i, const Vector3& force, Vector3& first, Vector3& second) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(i)];
    const Vector3 omega = node.R * node.Omega, alpha = node.R * node.Omegadot;
    first = omega.cross(force);
    second = omega.cross(first) + alpha.cross(force);
  };
  Vector3 first, second;
  for (int i = 0; i < static_cast<int>(state.nodes.size()); ++i) {
    const NodeFreedom& freedom = system_.kinematics().freedom(i);
    const int translations = freedom.count - freedom.rotations;
    if (translations == 0) continue;
    const auto G = freedom.G.topLeftCorner(3, translations);
    turned(i, G * f_.segment(freedom.begin, translations), first, second);
    f1_.segment(freedom.begin, translations) = G.transpose() * first;
    f2_.segment(freedom.begin, translations) = G.transpose() * second;
  }
  for (Eigen::Index k = 0; k < support_.cols(); ++k)
    for (const int row : {0, 3}) {
      turned(efforts_.nodes()[static_cast<std::size_t>(k)], support_.col(k).segment<3>(row), first, second);
      support1_.col(k).segment<3>(row) = first;
      support2_.col(k).segment<3>(row) = second;
    }
}

/// Solves (size) for a residual's derivative; the part of the efforts is separate.
VectorX QuasiStaticMotion::solve_rates(const State& still, Extended r, const EffortResponse& response,
                                       VectorX& effort_rate) const {
  VectorX solution(system_.size());
  tangent_.solve(r.head(system_.size()), solution);
  if (!efforts_.any()) return solution;
  effort_rate = response.change(r.tail(efforts_.count()) + EffortsAtRest::answer(efforts_, statics_, still, solution));
  return solution + response.step(effort_rate);
}

/// Sets the rates of the path in a state that is in equilibrium with f.
void QuasiStaticMotion::find_rates(State& state) {
  const int dofs = system_.dofs(), multipliers = system_.multipliers();
  const State still = at_standstill(state);
  follow(state);
  tangent_.factor(still, statics_);
  EffortResponse response;
  if (efforts_.any()) response = EffortsAtRest::response(efforts_, statics_, still, tangent_);
  supports_move_ = do_supports_move(still);
  VectorX velocity(multipliers), acceleration(multipliers), unused = effort_rate_;
  const VectorX zero = VectorX::Zero(dofs);
  State moving = still;
  system_.set_rates(moving, zero, zero);
  system_.constraint_rates(moving, environment_, velocity, acceleration);
  Extended r = derivative(still, 0, 1);
  put_constraints(still, velocity, r);
  VectorX solution = solve_rates(still, r, response, effort_rate_);
  v_ = solution.head(dofs);
  lambda_rate_ = solution.tail(multipliers);
  system_.set_rates(moving, v_, zero);
  system_.constraint_rates(moving, environment_, velocity, acceleration);
  r = derivative(still, 1, 2);
  put_constraints(still, acceleration, r);
  a_ = solve_rates(still, r, response, unused).head(dofs);
  system_.set_rates(state, v_, a_);
}

/// Sets the rows of active constraints; the other rows are zero.
void QuasiStaticMotion::put_constraints(const State& state, const VectorX& rows, VectorX& r) const {
  const int first = system_.size() - system_.multipliers();
  r.segment(first, rows.size()) = rows;
  system_.for_each_idle(state, [&](int k) { r[first + k] = 0; });
}

/// Returns the forces of inertia and dampers: the parts that velocities and accelerations add to the residual (dofs),
/// and to the reactions of moved nodes (6 for each).
VectorX QuasiStaticMotion::inertia_of(const State& state) const {
  VectorX moving(system_.size()), resting(system_.size()), all(f_.size() + support_.size());
  const State still = at_standstill(state);
  system_.residual(state, environment_, moving);
  residual_at_rest(system_, statics_, still, resting);
  all.head(f_.size()) = (moving - resting).head(f_.size());
  if (efforts_.any()) {
    const MatrixX of_supports = efforts_.reactions(environment_, state) - efforts_.reactions(statics_, still);
    all.tail(support_.size()) = of_supports.reshaped();
  }
  return all;
}

/// Returns relative weights of forces of each kind: moments are divided by the mechanism's size, forces on amplitudes
/// have no weight.
VectorX QuasiStaticMotion::weights_of_inertia(const State& state) const {
  const double length = std::max(model_extent(state), 1e-30);
  VectorX weights = VectorX::Ones(f_.size() + support_.size());
  for (int i = 0; i < system_.dofs(); ++i)
    if (system_.kind(i) == Kind::rotation) weights[i] = 1 / length;
  for (Eigen::Index k = f_.size(); k < weights.size(); ++k)
    if ((k - f_.size()) % 6 >= 3) weights[k] = 1 / length;
  return weights;
}

void QuasiStaticMotion::load_by_inertia(State& state) {
  constexpr int most = 60;
  constexpr double settled = 1e-9;  // [rad], or relative to the extent: accuracy of inertia forces
  FixedPoint forces(weights_of_inertia(state));
  VectorX f = inertia_of(state);
  for (int k = 0; k < most; ++k) {
    f_ = f.head(f_.size());
    support_ = f.tail(support_.size()).reshaped(6, support_.cols());
    equilibrium_.push(-f_);
    efforts_at_rest_.push(support_);
    State next = state;
    equilibrate(equilibrium_, next);
    const double change = distance(state, next);
    system_.set_rates(next, v_, a_);
    state = std::move(next);
    find_rates(state);
    if (k > 0 && change <= settled) return;
    f = forces.next(f, inertia_of(state));
  }
  throw ComputationError(
      "the deformation under inertia forces does not settle: the motion is too fast for elastic parts that follow in "
      "equilibrium; take a dynamic analysis");
}

void QuasiStaticMotion::note_left_out(const State& state) {
  std::vector<Vector3> deformation;
  for (std::size_t i = 0; i < state.nodes.size(); ++i)
    deformation.push_back(state.nodes[i].R.transpose() * (state.nodes[i].x - path_.nodes[i].x));
  deformations_.push_back(std::move(deformation));
  times_.push_back(state.time);
  const std::size_t n = times_.size();
  if (n < 3) return;
  const double h = times_[n - 1] - times_[n - 2], before = times_[n - 2] - times_[n - 3];
  // A difference across a kink in the law of a drive only shows the kink.
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
