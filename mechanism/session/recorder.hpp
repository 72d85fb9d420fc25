// Sends the rows, events and results of an analysis to the sinks of a session.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "mechanism/results/recording.hpp"
#include "mechanism/results/result_sink.hpp"
#include "mechanism/session/step_recorders.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class Recorder {
 public:
  explicit Recorder(const System& system);

  void add_sink(ResultSink& sink) { sinks_.push_back(&sink); }  ///< the sink must outlive its use
  void remove_sink(const ResultSink& sink) { std::erase(sinks_, &sink); }
  /// @throws InputError if the interval of steps is less than 1
  void set_recording(Recording recording);
  const Recording& recording() const { return recording_; }

  /// @param goes_on  a sink in which the analysis is already open
  void begin_analysis(const std::string& type, std::size_t expected_rows, const ResultSink* goes_on);
  /// Returns the sinks of the open analysis; none if no analysis is open.
  std::vector<ResultSink*> open_sinks() const { return open_ ? sinks_ : std::vector<ResultSink*>(); }
  void record(const State& state, const Environment& environment, const StepRecord& step);  ///< sends a row
  void gather(const State& state, const Environment& environment);  ///< gives a state to the step recorders
  void note(const Event& event);
  void write(const ResultArray& array);
  void write(const ResultNames& names);
  /// Writes the results of the step recorders, and which reactions are unique. @param state  last state of the analysis
  void end_analysis(const State& state, const Environment& environment);
  void abandon_analysis() { open_ = false; }  ///< after a failure: nothing more is recorded of the analysis
  long rows() const { return rows_; }         ///< number of rows of this analysis
  StepRecorders& step_recorders() { return step_recorders_; }

  /// While it is muted, rows are not sent: steps are being repeated after a restart.
  void set_muted(bool muted) { muted_ = muted; }
  bool muted() const { return muted_; }

  /// Returns the state with the reactions to report: those of the smallest norm where they are not unique.
  const State& reported(const State& state, const Environment& environment) const;
  /// Reactions reported from now on do not depend on earlier pivots.
  void renew_reactions() { norm_.reset(); }

 private:
  const System& system_;
  Recording recording_;
  std::vector<ResultSink*> sinks_;
  StepRecorders step_recorders_;
  bool open_ = false, muted_ = false;
  long rows_ = 0;
  mutable std::unique_ptr<ReactionNorm> norm_;  ///< created if constraints are redundant
  mutable State reported_;
};

}  // namespace bielle::mechanism
