// Where results go: a file, memory, a plot. A session sends the same to each of its sinks.
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

/// A number of each of some entries, which is no row over time: "joints/main/reaction_unique".
struct EntryNumbers {
  std::string name;  ///< "reaction_unique"
  std::vector<std::pair<Entry, double>> values;
  std::string units, description;
};

/// A crossing of a motion.
struct Event {
  double time = 0;   ///< [s]
  int crossing = 0;  ///< by number, System::crossings
  std::string name;  ///< "event 'landed'", "joint 'door': angle at its upper stop"
};

class ResultSink {
 public:
  ResultSink() = default;
  virtual ~ResultSink() = default;
  ResultSink(const ResultSink&) = delete;
  ResultSink& operator=(const ResultSink&) = delete;

  /// @param type           as in the input file: "dynamic"
  /// @param expected_rows  how many rows will follow, 0 when unknown
  virtual void begin_analysis(const std::string& type, std::size_t expected_rows) = 0;
  /// A row. Its numbers are those that ResultsRows makes of the state.
  /// @param slots  of the model's members, in their order; they outlive the analysis
  virtual void record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                      const StepRecord& step) = 0;
  virtual void write(const ResultArray& array) = 0;
  virtual void write(const ResultNames& /*names*/) {}
  virtual void write(const EntryNumbers& numbers) = 0;  ///< of entries that record
  /// A crossing was met.
  virtual void note(const Event& event) = 0;
  virtual void end_analysis() = 0;
  virtual void complete() {}  ///< the analysis has ended as intended

  /// A point to go on from. @param archive  with all of it but what belongs to the sink itself
  virtual void checkpoint(Archive& /*archive*/) {}
  /// What rows to come take from those before: the sink's part of a point to go on from.
  virtual void exchange(Archive& /*archive*/) {}
};

}  // namespace bielle::mechanism
