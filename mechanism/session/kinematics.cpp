// Mechanisms whose every motion is driven: positions, velocities and accelerations follow from the constraints alone,
// time after time, and with them the forces of drives and joints that bring them about (inverse dynamics). Nothing is
// integrated: each time stands for itself, exact to rounding.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "mechanism/session/session.hpp"
#include "mechanism/session/time_grid.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"
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

/// Whether a time is one of some, which ascend, but for rounding [s].
bool contains(const std::vector<double>& times, double time, double rounding) {
  const auto from = std::lower_bound(times.begin(), times.end(), time - rounding);
  return from != times.end() && *from <= time + rounding;
}

constexpr double same_time = 1e-9;  // relative to the step

/// Equal steps, the times to record, and those where laws of drives have kinks (where velocities jump).
std::vector<double> times_of(const System& system, const KinematicsOptions& options, const Recording& recording,
                             double begin) {
  const long steps = grid_steps(options.duration, options.step);
  const double end = begin + options.duration, h = options.duration / static_cast<double>(steps);
  std::vector<double> times;
  for (long k = 1; k <= steps; ++k) times.push_back(k == steps ? end : begin + static_cast<double>(k) * h);
  for (const std::vector<double>& more : {recording.times, system.break_points()})
    for (const double time : more)
      if (time > begin && time < end) times.push_back(time);
  std::sort(times.begin(), times.end());
  // A time of the grid that is met but for rounding is met.
  const auto same = [&](double a, double b) { return b - a < same_time * h; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
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
  apply_motions(system_, 1, state_);
  system_.begin_motion(state_, environment_, false);
  if (const StartConditions conditions = start_conditions(); !conditions.empty())
    assemble_positions(system_, environment_, state_, report.start, conditions);
  report.start.add(make_consistent(system_, environment_, state_));
  started_ = true;
  shown_ = &state_;
  EnergyBalance books;
  const double begin = state_.time;
  const std::vector<double> times = times_of(system_, options, recording_, begin);
  const std::vector<double> kinks = system_.break_points();
  const double rounding = same_time * options.step;
  books.start(begin, system_.energy(state_, environment_));
  const auto point = [&](double step, bool recorded) {
    report_.emplace();
    report_->energy = books.totals();
    report_->balance = books.balance();
    report_->step = step;
    if (recorded) record(state_, environment_, *report_);
    gather(state_, environment_);
    ++report.points;
    if (notes_) notes_->progress((state_.time - begin) / options.duration, fmt::format("t = {:.6g} s", state_.time));
    if (state_.time > begin) call_back();
  };
  point(0, true);
  MassSaddle saddle(system_);
  for (std::size_t k = 0; k < times.size() && !stopping_; ++k) {
    State next = predicted(system_, state_, times[k]);
    try {
      StartReport unused;
      assemble_positions(system_, environment_, next, unused);
      make_velocities_consistent(system_, environment_, next, unused, saddle);
      system_.begin_branch(next, environment_);  // stops, contacts
      make_accelerations_consistent(system_, environment_, next, saddle);
      if (!contains(kinks, next.time, rounding)) check_continuous(system_, state_, next);
      system_.accept(next, environment_);
    } catch (const ComputationError& error) {
      const std::string time = fmt::format("t = {:.6g} s: ", next.time), why = error.what();
      throw ComputationError(why.starts_with("t = ") ? why : time + why);
    }
    const double step = next.time - state_.time;
    state_ = std::move(next);
    books.advance(state_.time, system_.energy(state_, environment_));
    const bool last = k + 1 == times.size();
    point(step, recording_.times.empty() ? (k + 1) % static_cast<std::size_t>(recording_.every) == 0 || last
                                         : contains(recording_.times, state_.time, rounding));
  }
  report.energy = books.totals();
  report.balance = books.balance();
  return report;
}

}  // namespace bielle::mechanism
