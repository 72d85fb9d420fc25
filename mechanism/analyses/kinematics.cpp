// Kinematics and inverse dynamics of mechanisms whose motions are all driven. At each time, positions, velocities and
// accelerations follow from the constraints alone, and the forces of drives and joints follow from these. Nothing is
// integrated: each time is solved independently, and exactly up to rounding.
#include "mechanism/analyses/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/analyses/delay_loops.hpp"
#include "mechanism/model/event_actions.hpp"
#include "mechanism/session/computation.hpp"
#include "mechanism/session/time_grid.hpp"
#include "mechanism/solvers/dynamics/event_locator.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/branch_sign.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "mechanism/solvers/start/continuous_motion.hpp"
#include "mechanism/solvers/start/sought_accelerations.hpp"
#include "mechanism/solvers/start/undriven_motions.hpp"
#include "mechanism/solvers/statics/quasi_static_motion.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the largest absolute entry of a vector over the dofs, translations multiplied by a factor.
double largest_entry(const System& system, const Eigen::Ref<const VectorX>& vector, double of_translations) {
  double largest = 0;
  for (int i = 0; i < system.dofs(); ++i)
    largest = std::max(largest, std::abs(vector[i]) * (system.kind(i) == Kind::translation ? of_translations : 1.0));
  return largest;
}

/// Tells whether gravity or loads act along any of these motions (dofs, motions).
bool is_loaded(const System& system, const Environment& environment, const State& state, const MatrixX& motions) {
  // Relative to the largest force along the largest motion; motions have errors of about 1e-9.
  constexpr double nothing = 1e-7;
  Environment statics = environment;
  statics.statics = true;
  State still = state;
  system.set_rates(still, VectorX::Zero(system.dofs()), VectorX::Zero(system.dofs()));
  still.multiplier.setZero();
  VectorX r(system.size());
  residual_at_rest(system, statics, still, r);
  const VectorX forces = r.head(system.dofs());
  const double length = std::max(model_extent(state), 1e-30), force = largest_entry(system, forces, length);
  for (Eigen::Index k = 0; k < motions.cols(); ++k)
    if (std::abs(motions.col(k).dot(forces)) > nothing * force * largest_entry(system, motions.col(k), 1 / length))
      return true;
  return false;
}

/// Throws if a motion that has to be driven is free.
/// @param elastic  whether elastic parts may deform, and motions that are not loaded or determined stay at rest
/// @returns the coordinates that describe motions which stay at rest
std::vector<std::string> check_driven(const System& system, const Environment& environment, const State& state,
                                      const Mobility& mobility, bool elastic) {
  std::vector<std::string> indifferent;
  if (mobility.degrees > 0) {
    if (const std::string singular = describe_singular_start(system, environment, state); !singular.empty())
      throw InputError(singular);
    UndrivenMotions undriven = find_undriven(system, environment, state);
    const auto count = static_cast<int>(undriven.names.size());
    if (!elastic || is_loaded(system, environment, state, undriven.directions)) {
      const bool flexible = count < mobility.degrees;
      throw InputError(fmt::format(
          "{} not driven{}: kinematics and inverse dynamics need a motion for each (drives of joints, `motion` of "
          "nodes){}. A dynamic analysis takes what is driven and what is free",
          counted(elastic ? count : mobility.degrees, "degree of freedom is", "degrees of freedom are"),
          count == 0 ? "" : fmt::format(" ({})", fmt::join(undriven.names, ", ")),
          flexible && !elastic ? "; `kinematic` takes rigid parts, `inverse_dynamics` elastic ones as well" : ""));
    }
    indifferent = std::move(undriven.names);
  }
  for (int k = 0; k < system.multipliers(); ++k)
    if (system.constraint_kind(k) == ConstraintKind::nonholonomic)
      throw InputError(fmt::format(
          "{} is a condition on velocities (a drive of `rate`, rolling), from which positions do not follow: give the "
          "motion itself, or take a dynamic analysis",
          system.equation_name(system.size() - system.multipliers() + k)));
  if (system.first_orders() > 0)
    throw InputError(
        fmt::format("{} has a motion of its own, which kinematics cannot determine: take a dynamic analysis",
                    system.unknown_name(system.dofs())));
  return indifferent;
}

/// Tells whether a time is in an ascending list, up to rounding [s].
bool contains(const std::vector<double>& times, double time, double rounding) {
  const auto from = std::lower_bound(times.begin(), times.end(), time - rounding);
  return from != times.end() && *from <= time + rounding;
}

/// Refuses events that switch parts on or off: without inertia, the motion after such an event is not determined.
void check_events(const Model& model) {
  for (const Member& member : model.members())
    if (const auto* actions = dynamic_cast<const EventActions*>(member.component.get());
        actions && actions->switches_parts())
      throw InputError(
          fmt::format("{} locks, releases or activates something: a prescribed motion has no inertia by which it would "
                      "go on; take a "
                      "dynamic analysis (actions `set` and `stop` are possible here)",
                      describe(member)));
}

constexpr double same_time = 1e-9;  // relative to the step

/// Returns the times of equal steps, the times to record, and the kinks of the laws of drives (at which velocities
/// jump).
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
  // Times that agree with a time of the grid up to rounding are removed.
  const auto same = [&](double a, double b) { return b - a < same_time * h; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

/// Computes positions, velocities, accelerations and reactions of driven rigid parts.
class RigidPositions {
 public:
  RigidPositions(const System& system, const Environment& environment, const SoughtEfforts& efforts)
      : system_(system), environment_(environment), efforts_(efforts), saddle_(system) {}
  /// Finds the sought efforts at a state that is not yet consistent with any efforts.
  void begin(State& state) { find_sought_efforts(efforts_, environment_, state, saddle_); }
  State operator()(const State& from, double time) {
    State next = predicted(system_, from, time);
    StartReport unused;
    assemble_positions(system_, environment_, next, unused);
    make_velocities_consistent(system_, environment_, next, unused, saddle_);
    system_.begin_branch(next, environment_);  // updates stops and contacts
    make_accelerations_consistent(system_, environment_, next, saddle_);
    find_sought_efforts(efforts_, environment_, next, saddle_);
    return next;
  }

 private:
  const System& system_;
  const Environment& environment_;
  const SoughtEfforts& efforts_;
  KktMatrix saddle_;
};

/// A prescribed motion from time to time, and from event to event.
class CrossedMotion {
 public:
  CrossedMotion(const System& system, const Environment& environment, ContinuousMotion::Position position)
      : system_(system),
        environment_(environment),
        sign_(system),
        motion_(system, std::move(position),
                [this](const State& one, const State& other) { return sign_.same(environment_, one, other); }),
        watch_(system) {}
  CrossedMotion(const CrossedMotion&) = delete;
  CrossedMotion& operator=(const CrossedMotion&) = delete;

  /// This function must be called before each step. @returns the events that occur because velocities or forces have
  /// jumped
  std::vector<int> begin(State& state) {
    const std::vector<int> jumped = watch_.begin(state, environment_, passed_);
    if (!jumped.empty()) system_.begin_branch(state, environment_, jumped);
    return jumped;
  }
  /// Advances a state to a time. If an event that ends steps occurs before this time, the state is advanced to just
  /// after the event, by at most a billionth of the step.
  /// @param jumps  whether velocities may jump at that time
  /// @returns the events that occur, in their order
  std::vector<EventLocator::Noted> advance(State& state, double time, bool jumps) {
    State next = motion_.advance(state, time, jumps);
    const double h = time - state.time;
    passed_.clear();
    if (!watch_.idle() && watch_.found(next, environment_, h, same_time * h)) {
      while (!watch_.located()) {
        const double part = watch_.proposal();
        watch_.narrow(motion_.advance(state, state.time + part, false), environment_, part);
      }
      passed_ = watch_.pass();
      if (watch_.behind() < h) next = motion_.advance(state, state.time + watch_.behind(), false);
    }
    const auto between = [&](double at) { return motion_.advance(state, at, false); };
    std::vector<EventLocator::Noted> met =
        watch_.idle() ? std::vector<EventLocator::Noted>()
                      : watch_.pass_noted(state.time, next.time, between, environment_, same_time * h);
    std::sort(met.begin(), met.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    system_.accept(next, environment_);
    if (!passed_.empty()) system_.begin_branch(next, environment_, passed_);
    for (const int k : passed_) met.push_back({next.time, k});
    state = std::move(next);
    return met;
  }

 private:
  const System& system_;
  const Environment& environment_;
  BranchSign sign_;
  ContinuousMotion motion_;
  EventLocator watch_;
  std::vector<int> passed_;  ///< sides of the event functions at the end of the last step
};

/// @returns whether one of the events ends the analysis
bool note_events(const System& system, const std::vector<EventLocator::Noted>& crossed, Computation& computation,
                 KinematicsReport& report) {
  bool stops = false;
  for (const EventLocator::Noted& each : crossed) {
    const MemberEventFunction& met = system.event_functions()[static_cast<std::size_t>(each.event_function)];
    computation.note(Event{each.time, each.event_function, met.name});
    report.last_event = met.name;
    ++report.events;
    stops = stops || met.function.stops;
  }
  return stops;
}

void begin_kinematics(const Session& session, const KinematicsOptions& options, Computation& computation,
                      KinematicsReport& report) {
  const System& system = session.system();
  const Environment& environment = session.environment();
  State& state = computation.state();
  computation.set_acting(environment);
  computation.loaded() = {1, 1};
  apply_motions(system, 1, state);
  system.begin_motion(state, environment, false);
  if (const StartConditions conditions = session.start_conditions(); !conditions.empty())
    assemble_positions(system, environment, state, report.start, conditions);
  report.indifferent = check_driven(system, environment, state, session.mobility(), options.elastic);
  report.elastic = options.elastic && session.mobility().degrees > 0;
  if (const std::vector<std::string> delays = describe_delays(session.model()); report.elastic && !delays.empty())
    throw InputError(fmt::format(
        "{}: elastic parts follow a prescribed motion through states of equilibrium, which have no history; take a "
        "dynamic analysis",
        counted(delays.size(), "delay", "delays") + " (" + fmt::format("{}", fmt::join(delays, ", ")) + ")"));
  report.start.add(make_consistent(system, environment, state));
  computation.set_started();
}

}  // namespace

KinematicsReport compute_kinematics(Session& session, const KinematicsOptions& options) {
  if (!(options.duration > 0) || !(options.step > 0))
    throw InputError("kinematics needs a duration and a step greater than 0");
  const System& system = session.system();
  check_events(session.model());
  const Environment& environment = session.environment();
  const Recording& recording = session.recording();
  KinematicsReport report;
  const SoughtEfforts efforts(system);
  Computation computation(session);
  State& state = computation.state();
  begin_kinematics(session, options, computation, report);
  EnergyBalance energy_balance;
  const double begin = state.time;
  const std::vector<double> times = times_of(system, options, recording, begin);
  const std::vector<double> kinks = system.break_points();
  const double rounding = same_time * options.step;
  RigidPositions rigid(system, environment, efforts);
  std::optional<QuasiStaticMotion> elastic;
  if (report.elastic)
    elastic.emplace(system, environment, efforts, options.step).begin(state);
  else
    rigid.begin(state);
  CrossedMotion motion(system, environment, [&](const State& from, double time) {
    return elastic ? elastic->position(from, time) : rigid(from, time);
  });
  energy_balance.start(begin, system.energy(state, environment));
  const auto point = [&](double step, bool recorded) {
    StepRecord row;
    row.energy = energy_balance.totals();
    row.balance = energy_balance.balance();
    row.step = step;
    computation.show(state, environment, row, recorded);
    if (elastic) elastic->note_left_out(state);
    ++report.points;
    if (Notes* notes = session.notes())
      notes->progress((state.time - begin) / options.duration, [&] { return fmt::format("t = {:.6g} s", state.time); });
    if (state.time > begin) session.call_back();
  };
  point(0, true);
  double last = begin;
  for (std::size_t k = 0; k < times.size() && !session.stopping() && !report.stopped_by_event;) {
    try {
      std::vector<EventLocator::Noted> jumped;
      for (const int event : motion.begin(state)) jumped.push_back({state.time, event});
      report.stopped_by_event = note_events(system, jumped, computation, report);
      if (report.stopped_by_event) break;
      const bool jumps = contains(kinks, times[k], rounding);
      report.stopped_by_event = note_events(system, motion.advance(state, times[k], jumps), computation, report);
    } catch (const ComputationError& error) {
      const std::string time = fmt::format("t = {:.6g} s: ", times[k]), why = error.what();
      throw ComputationError(why.starts_with("t = ") ? why : time + why);
    }
    energy_balance.advance(state.time, system.energy(state, environment));
    const bool ends = report.stopped_by_event;
    if (state.time < times[k] && !ends) continue;  // an event between two times
    ++k;
    const bool asked_for = recording.times.empty()
                               ? k % static_cast<std::size_t>(recording.every) == 0 || k == times.size()
                               : contains(recording.times, state.time, rounding);
    point(state.time - last, asked_for || ends);
    last = state.time;
  }
  if (elastic) report.left_out = elastic->left_out();
  report.energy = energy_balance.totals();
  report.balance = energy_balance.balance();
  return report;
}

}  // namespace bielle::mechanism
