#include "mechanism/solvers/dynamics/velocity_correction.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {

VelocityCorrection::VelocityCorrection(const System& system, const Environment& environment, ConstraintForm form)
    : system_(system), environment_(environment), form_(form), saddle_(system) {}

void VelocityCorrection::exchange(Archive& archive) {
  archive(turning_);
  saddle_.choose_pivots_anew();
}

/// Computes B c: the change of the constraint rates if the accelerations change by c.
VectorX VelocityCorrection::target(const State& state, const VectorX& v, const VectorX& a, const VectorX& j,
                                   const Scheme& scheme) const {
  VectorX c = scheme.position_error() * j;
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const NodeFreedom& f = system_.kinematics().freedom(static_cast<int>(i));
    if (f.rotations == 3)
      c.segment<3>(f.begin + f.count - 3) += state.nodes[i].Omega.cross(state.nodes[i].Omegadot) / 12;
  }
  VectorX velocity(system_.multipliers()), with(system_.multipliers()), without(system_.multipliers());
  State moved = state;
  system_.set_rates(moved, v, a + c);
  system_.constraint_rates(moved, environment_, velocity, with);
  system_.constraint_rates(state, environment_, velocity, without);
  VectorX target = with - without;
  keep_holonomic(state, target);
  return target;
}

/// Sets entries to zero that are not active constraints of positions: constraints of velocities are satisfied by those
/// of the scheme.
void VelocityCorrection::keep_holonomic(const State& state, VectorX& rows) const {
  for (int k = 0; k < system_.multipliers(); ++k)
    if (system_.constraint_kind(k) != ConstraintKind::holonomic) rows[k] = 0;
  system_.for_each_idle(state, [&](int k) { rows[k] = 0; });
}

/// Returns the smallest change of velocities, in the norm of kinetic energy, that reduces the constraint rates by
/// `rate`.
VectorX VelocityCorrection::across_constraints(const State& state, const VectorX& rate) {
  if (!saddle_.serves()) saddle_.factor(environment_, state);
  VectorX r = VectorX::Zero(system_.size()), change(system_.size());
  r.tail(system_.multipliers()) = rate;
  saddle_.solve(r, change);
  return change.head(system_.dofs());
}

void VelocityCorrection::add_offset(SchemeStep& step, const VectorX& j, double factor) {
  if (system_.multipliers() == 0 || form_ == ConstraintForm::stabilised) return;
  SchemeStep::Rates& rates = step.rates();
  rates.v += across_constraints(step.state(), -factor * target(step.state(), rates.v, rates.a, j, step.scheme()));
}

double VelocityCorrection::turn_of_constraints(const SchemeStep& step) const {
  double rate = 0;
  for (std::size_t m = 0; m < system_.slots().size(); ++m) {
    const Slots& slots = system_.slots()[m];
    if (slots.multipliers == 0) continue;
    rate = std::max(
        rate, system_.model().members()[m].component->turning_rate(LocalState(step.trial(), slots, environment_)));
  }
  return rate * step.trial_size();
}

double VelocityCorrection::turn_of_motion(const SchemeStep& step) {
  State state = step.state();
  const double kinetic = system_.energy(state, environment_).kinetic;
  if (!(kinetic > 0)) return 0;
  const int m = system_.multipliers();
  system_.set_rates(state, step.rates().v, VectorX::Zero(system_.dofs()));
  VectorX unused(m), curving(m);
  system_.constraint_rates(state, environment_, unused, curving);
  keep_holonomic(state, curving);
  if (!watching_saddle_) watching_saddle_.emplace(system_);
  watching_saddle_->factor(environment_, state);
  VectorX r = VectorX::Zero(system_.size()), solution(system_.size());
  r.tail(m) = curving;
  watching_saddle_->solve(r, solution);
  return step.size() * std::sqrt(std::abs(curving.dot(solution.tail(m))) / (2 * kinetic));
}

void VelocityCorrection::correct(SchemeStep& step) {
  const int m = system_.multipliers();
  const double h = step.trial_size();
  const State& trial = step.trial();
  VectorX rate(m), unused(m);
  system_.constraint_rates(trial, environment_, rate, unused);
  keep_holonomic(trial, rate);
  rate -= h * h * target(trial, step.trial_velocity(), step.trial_acceleration(), step.rates().j, step.scheme());
  saddle_.serve_no_more();
  const VectorX v = step.trial_velocity() + across_constraints(trial, rate);
  saddle_.serve_no_more();
  step.set_trial_velocity(v);
}

void VelocityCorrection::watch(SchemeStep& step) {
  if (system_.multipliers() == 0) return;
  turn_ = turn_of_constraints(step);
  if (form_ != ConstraintForm::corrected) return;
  if (!turning_) turning_ = turn_ > 0.5 * step.scheme().most_turn();
  if (turning_) correct(step);
}

std::string VelocityCorrection::caution(const SchemeStep& step) {
  // The stabilised form permits at least seven times as much: 0.55 rad with rho = 0.95, 1.1 with 0.8. This holds for
  // the linearised equations as well.
  const double most = (form_ == ConstraintForm::stabilised ? 7 : 1) * step.scheme().most_turn();
  const double time = step.state().time;
  constexpr double none = 1e-6;
  if (form_ != ConstraintForm::corrected && turn_ > std::max(most, none))
    return fmt::format(
        "t = {:.6g} s: a joint turns by {:.2g} rad in a step of {:.3g} s; with this scheme and form of constraints, "
        "errors of joint forces may grow from {:.2g} rad on: take smaller steps, or `constraints: corrected` (the "
        "default)",
        time, turn_, step.size(), most);
  constexpr double tolerable = 0.01;
  const auto lag = [&](double turn) { return -step.scheme().position_error() * turn * turn; };
  if (lag(turn_) > tolerable) {
    // A rotation that does not bend the path, such as that of a wheel on its axle, causes no lag.
    if (const double turn = turn_of_motion(step); lag(turn) > tolerable)
      return fmt::format(
          "t = {:.6g} s: the path bends by {:.2g} rad in a step of {:.3g} s; such steps are stable, but positions fall "
          "behind by about {:.1g} of each turn: take smaller ones, or give a `tolerance`",
          time, turn, step.size(), lag(turn));
  }
  return {};
}

}  // namespace bielle::mechanism
