// Interface of receivers of results: a file, memory, a plot. A session sends the same data to each of its sinks.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/model/archive.hpp"
#include "mechanism/model/entry.hpp"
#include "mechanism/model/result_array.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/results/step_record.hpp"

namespace bielle::mechanism {

/// A number for each of several entries, which is not a row over time: "joints/main/reaction_unique".
struct EntryNumbers {
  std::string name;  ///< "reaction_unique"
  std::vector<std::pair<Entry, double>> values;
  std::string units, description;
};

/// An event of a motion.
struct Event {
  double time = 0;         ///< time [s]
  int event_function = 0;  ///< index in System::event_functions
  std::string name;        ///< name: "event 'landed'", "joint 'door': angle at its upper stop"
};

class ResultSink {
 public:
  ResultSink() = default;
  virtual ~ResultSink() = default;
  ResultSink(const ResultSink&) = delete;
  ResultSink& operator=(const ResultSink&) = delete;

  /// @param type           as in the input file: "dynamic"
  /// @param expected_rows  expected number of rows, 0 if unknown
  virtual void begin_analysis(const std::string& type, std::size_t expected_rows) = 0;
  /// Receives a row. Its values are those that ResultsRows computes from the state.
  /// @param slots  slots of the model's members, in their order; they outlive the analysis
  virtual void record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                      const StepRecord& step) = 0;
  virtual void write(const ResultArray& array) = 0;
  virtual void write(const ResultNames& /*names*/) {}
  virtual void write(const EntryNumbers& numbers) = 0;  ///< numbers of entries that are recorded
  /// Receives an event.
  virtual void note(const Event& event) = 0;
  virtual void end_analysis() = 0;
  virtual void complete() {}  ///< the analysis has ended without an error

  /// Receives a checkpoint. @param archive  contains the whole checkpoint except the sink's own part
  virtual void checkpoint(Archive& /*archive*/) {}
  /// Exchanges the sink's own part of a checkpoint: data of earlier rows that later rows depend on.
  virtual void exchange(Archive& /*archive*/) {}
};

}  // namespace bielle::mechanism
