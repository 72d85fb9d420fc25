#include "mechanism/session/recorder.hpp"

#include <stdexcept>
#include <utility>

#include "mechanism/session/unique_reactions.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

Recorder::Recorder(const System& system) : system_(system), step_recorders_(system.model()) {}

void Recorder::set_recording(Recording recording) {
  if (recording.every < 1) throw InputError("rows are recorded every 1, 2, ... steps");
  recording_ = std::move(recording);
}

void Recorder::begin_analysis(const std::string& type, std::size_t expected_rows, const ResultSink* goes_on) {
  open_ = true;
  rows_ = 0;
  step_recorders_.begin();
  for (ResultSink* sink : sinks_)
    if (sink != goes_on) sink->begin_analysis(type, expected_rows);
}

void Recorder::record(const State& state, const Environment& environment, const StepRecord& step) {
  if (!open_) return;
  const State& whole = reported(state, environment);
  if (muted_) return;
  ++rows_;
  for (ResultSink* sink : sinks_) sink->record(whole, system_.slots(), environment, step);
}

void Recorder::gather(const State& state, const Environment& environment) {
  if (open_) step_recorders_.add(state, system_.slots(), environment);
}

void Recorder::note(const Event& event) {
  if (open_)
    for (ResultSink* sink : sinks_) sink->note(event);
}

void Recorder::write(const ResultArray& array) {
  if (!open_) throw std::logic_error("a result outside of an analysis");
  for (ResultSink* sink : sinks_) sink->write(array);
}

void Recorder::write(const ResultNames& names) {
  if (!open_) throw std::logic_error("a result outside of an analysis");
  for (ResultSink* sink : sinks_) sink->write(names);
}

void Recorder::end_analysis(const State& state, const Environment& environment) {
  if (open_)
    for (const ResultArray& array : step_recorders_.results()) write(array);
  if (open_ && rows_ > 0)
    if (const EntryNumbers numbers = unique_reaction_numbers(system_, environment, state); !numbers.values.empty())
      for (ResultSink* sink : sinks_) sink->write(numbers);
  open_ = false;
  for (ResultSink* sink : sinks_) sink->end_analysis();
}

const State& Recorder::reported(const State& state, const Environment& environment) const {
  if (!ReactionNorm::needed(system_, state)) return state;
  if (!norm_) norm_ = std::make_unique<ReactionNorm>(system_);
  reported_ = state;
  norm_->balance(environment, reported_);
  return reported_;
}

}  // namespace bielle::mechanism
