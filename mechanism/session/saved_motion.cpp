// Writing of a motion, and its continuation from the saved numbers.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mechanism/session/computation.hpp"
#include "mechanism/session/motion.hpp"
#include "mechanism/session/motion_steps.hpp"
#include "mechanism/session/session.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Returns whether two states agree bit by bit.
bool same_motion(const State& a, const State& b) {
  const auto same = [](const NodeState& one, const NodeState& other) {
    return one.x == other.x && one.R == other.R && one.v == other.v && one.Omega == other.Omega;
  };
  return a.time == b.time && std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same) &&
         a.amplitude == b.amplitude && a.amplitude_rate == b.amplitude_rate && a.first_order == b.first_order &&
         a.multiplier == b.multiplier;
}

}  // namespace

void Motion::exchange_energy_balance(Archive& archive, Parts& parts) {
  archive.within(parts.steps, 0, 1e15);
  archive.within(parts.saves, 0, 1e15);
  archive(parts.begin);
  archive.within(parts.grid_steps, 0, 1e15);
  parts.energy_balance.exchange(archive);
  archive.of_any_length(parts.gathered);
}

/// Writes the motion, and the numbers of the sink at the end.
void Motion::write(Archive& archive, ResultSink* sink) {
  Recorder& recorder = session_.recorder();
  parts_.gathered = recorder.step_recorders().numbers();
  exchange_energy_balance(archive, parts_);
  parts_.integration->exchange(archive);
  parts_.march->exchange(archive);
  if (sink) sink->exchange(archive);
  recorder.renew_reactions();
}

Motion::Parts Motion::read(Archive& archive, Notes* notes) {
  session_.recorder().renew_reactions();
  Parts parts;
  exchange_energy_balance(archive, parts);
  StepOptions stepping = stepping_of(options_, session_.system(), parts.begin, notes);
  parts.integration = std::make_unique<TimeIntegration>(session_.system(), session_.environment(), options_.scheme,
                                                        archive, options_.form, options_.newton);
  if (!(parts.begin <= parts.integration->state().time))
    throw std::out_of_range("the motion stands before its beginning");
  make_march(parts, std::move(stepping));
  parts.march->exchange(archive);
  return parts;
}

/// Continues from a checkpoint at which tangents were rebuilt, or from a checkpoint of an interruption; the latter is
/// stored together with the former.
/// @throws std::out_of_range, InputError
void Motion::go_on(Archive& archive, ResultSink* sink) {
  Parts now = read(archive, session_.notes());
  if (sink) sink->exchange(archive);
  Parts anchor;
  const bool interrupted = now.steps > 0 && !archive.exhausted();
  if (interrupted)
    anchor = read(archive, nullptr);
  else if (!archive.exhausted())
    throw std::out_of_range("there are more numbers than are needed");
  session_.recorder().step_recorders().set(now.gathered);
  computation_ = std::make_unique<Computation>(session_);
  parts_ = std::move(now);
  if (interrupted && arrives(std::move(anchor))) return;
  parts_.steps = parts_.saves = 0;
}

/// Repeats the steps from the checkpoint at which tangents were rebuilt to that of the interruption: the motion then
/// has the tangents, pivots and rounding errors of an uninterrupted one. @returns false if it does not arrive at the
/// same state (steps or scheme have been changed); the motion then has the state of the interruption
bool Motion::arrives(Parts anchor) {
  Recorder& recorder = session_.recorder();
  Parts interrupted = std::exchange(parts_, std::move(anchor));
  const long steps = interrupted.steps;
  bool arrived = false;
  recorder.set_muted(true);
  try {
    recorder.step_recorders().set(parts_.gathered);
    while (parts_.steps < steps && !parts_.march->done()) take_step(false);
    arrived = same_motion(state(), interrupted.integration->state());
  } catch (const ComputationError&) {
    // The steps differ from the earlier ones.
  }
  recorder.set_muted(false);
  if (!arrived) {
    recorder.step_recorders().set(interrupted.gathered);
    parts_ = std::move(interrupted);
    return false;
  }
  parts_.march->count_as_before();
  parts_.saves = interrupted.saves;
  anchored_ = true;
  return true;
}

/// Saves the motion for all sinks. It is called even if there are none, because the motion must not depend on this.
void Motion::save_for_sinks() {
  if (saved_) return;
  parts_.steps = parts_.saves = 0;
  anchored_ = !session_.recorder().open_sinks().empty();
  write_to_sinks();
}

void Motion::write_to_sinks() {
  const auto save = [&](ResultSink* sink) {
    Archive archive;
    write(archive, sink);
    if (sink) sink->checkpoint(archive);
  };
  const std::vector<ResultSink*> sinks = session_.recorder().open_sinks();
  for (ResultSink* sink : sinks) save(sink);
  if (sinks.empty()) save(nullptr);
  saved_ = true;
}

/// Tangents are rebuilt at a checkpoint, both in this run and in the continued one. If the user has requested
/// checkpoints at an interval of steps, an uninterrupted run rebuilds tangents only at these: a continued run then
/// starts from the last of them and repeats the steps up to the interruption (`arrives`). Therefore all later steps are
/// identical bit by bit.
void Motion::save_where_interrupted() {
  if (!computation_ || saved_) return;
  if (!anchored_ || session_.recording().checkpoint == 0) return save_for_sinks();
  ++parts_.saves;
  write_to_sinks();
  anchored_ = false;  // tangents are rebuilt if this program continues
}

}  // namespace bielle::mechanism
