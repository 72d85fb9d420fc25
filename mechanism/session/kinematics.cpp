// Mechanisms whose every motion is driven: positions, velocities and accelerations follow from the constraints alone,
// time after time, and with them the forces of drives and joints that bring them about (inverse dynamics). Nothing is
// integrated: each time stands for itself, exact to rounding.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/session/session.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

void check_driven(const System& system, const Mobility& mobility) {
  if (mobility.degrees > 0)
    throw InputError(fmt::format(
        "{} not driven: kinematics and inverse dynamics need a motion for each (drives of joints, `motion` of nodes), "
        "and rigid parts; flexible ones deform by themselves. A dynamic analysis takes what is driven and what is free",
        counted(mobility.degrees, "degree of freedom is", "degrees of freedom are")));
  for (int k = 0; k < system.multipliers(); ++k)
    if (system.constraint_kind(k) == ConstraintKind::nonholonomic)
      throw InputError(fmt::format(
          "{} is a condition on velocities (a drive of `rate`, rolling), from which positions do not follow: give the "
          "motion itself, or take a dynamic analysis",
          system.equation_name(system.size() - system.multipliers() + k)));
  if (system.first_orders() > 0)
    throw InputError(fmt::format("{} has a motion of its own, which kinematics cannot tell: take a dynamic analysis",
                                 system.unknown_name(system.dofs())));
}

/// Throws where two positions do not belong to one motion: velocities that jump against their accelerations are those
/// of another branch, as a dead centre that is met exactly leaves it open.
void check_continuous(const System& system, const State& from, const State& to) {
  constexpr double most = 0.6;  // of the larger one: the trapezoidal rule errs by h^2 w^2/12 of it
  VectorX v(system.dofs()), a(system.dofs()), v_to(system.dofs()), a_to(system.dofs());
  system.get_rates(from, v, a);
  system.get_rates(to, v_to, a_to);
  const double h = to.time - from.time, length = std::max(model_extent(to), 1e-30);
  double change = 0, gap = 0, speed = 0;
  for (int i = 0; i < system.dofs(); ++i) {
    const double size = system.kind(i) == Kind::translation ? 1 / length : 1, dv = v_to[i] - v[i];
    const double by_a = 0.5 * h * (a[i] + a_to[i]);
    change = std::max(change, size * std::max(std::abs(dv), std::abs(by_a)));
    gap = std::max(gap, size * std::abs(dv - by_a));
    speed = std::max(speed, size * std::max(std::abs(v[i]), std::abs(v_to[i])));
  }
  if (gap > most * change && gap > most * speed)
    throw ComputationError(
        "velocities and accelerations do not fit to those a step before: either the steps are too large to tell that "
        "this is the same motion, a drive jumps, or a dead centre is met, where the mechanism may go on in two ways: "
        "take smaller or other steps");
}

/// The state a time later, by its velocities and accelerations: where the search for the next position begins.
State predicted(const System& system, const State& state, double time) {
  const double h = time - state.time;
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  State next = state;
  next.time = time;
  system.displace(next, state, h * v + 0.5 * h * h * a);
  system.set_rates(next, v + h * a, a);
  return next;
}

}  // namespace

KinematicsReport Session::kinematics(const KinematicsOptions& options) {
  if (!(options.duration > 0) || !(options.step > 0))
    throw InputError("kinematics needs a duration and a step greater than 0");
  check_driven(system_, mobility_);
  at_rest();
  stopping_ = false;
  acting_ = environment_;
  loaded_ = {1, 1};
  KinematicsReport report;
  if (state_.motion_factor != 1) {
    state_.motion_factor = 1;
    system_.displace(state_, State(state_), VectorX::Zero(system_.dofs()));
  }
  system_.begin_motion(state_, environment_, false);
  if (const StartConditions conditions = start_conditions(); !conditions.empty())
    assemble_positions(system_, environment_, state_, report.start, conditions);
  report.start.add(make_consistent(system_, environment_, state_));
  started_ = true;
  shown_ = &state_;
  EnergyBalance books;
  const double begin = state_.time;
  const long steps = std::max(1L, std::lround(std::ceil(options.duration / options.step * (1 - 1e-12))));
  const double h = options.duration / static_cast<double>(steps);
  books.start(begin, system_.energy(state_, environment_));
  const auto point = [&](long k) {
    report_.emplace();
    report_->energy = books.totals();
    report_->balance = books.balance();
    report_->step = h;
    if (k % recording_.every == 0 || k == steps) record(state_, environment_, *report_);
    gather(state_, environment_);
    ++report.points;
    if (notes_)
      notes_->progress(static_cast<double>(k) / static_cast<double>(steps), fmt::format("t = {:.6g} s", state_.time));
    if (k > 0) call_back();
  };
  point(0);
  MassSaddle saddle(system_);
  for (long k = 1; k <= steps && !stopping_; ++k) {
    State next = predicted(system_, state_, begin + static_cast<double>(k) * h);
    try {
      StartReport unused;
      assemble_positions(system_, environment_, next, unused);
      make_velocities_consistent(system_, environment_, next, unused, saddle);
      system_.begin_branch(next, environment_);  // stops, contacts
      make_accelerations_consistent(system_, environment_, next, saddle);
      check_continuous(system_, state_, next);
      system_.accept(next, environment_);
    } catch (const ComputationError& error) {
      const std::string time = fmt::format("t = {:.6g} s: ", next.time), why = error.what();
      throw ComputationError(why.starts_with("t = ") ? why : time + why);
    }
    state_ = std::move(next);
    books.advance(state_.time, system_.energy(state_, environment_));
    point(k);
  }
  report.energy = books.totals();
  report.balance = books.balance();
  return report;
}

}  // namespace bielle::mechanism
