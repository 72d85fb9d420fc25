// Keeps results in memory: for programs that need no file.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/results/result_sink.hpp"
#include "mechanism/results/results_rows.hpp"

namespace bielle::mechanism {

class MemorySink : public ResultSink {
 public:
  /// The recorded results of one analysis.
  struct Recorded {
    std::string type;
    std::vector<double> time;
    std::vector<double> values;  ///< values, row after row
    std::map<std::string, ResultArray> arrays;
    std::map<std::string, std::vector<std::string>> names;
    std::vector<Event> events;
  };
  explicit MemorySink(const Model& model) : rows_(model) {}  ///< the model must outlive this object

  const std::vector<Recorded>& analyses() const { return analyses_; }
  /// Reads a dataset of an analysis, row after row, with the name that it has in a results file; "time" too.
  /// @param analysis  number of the analysis, from 0. @throws InputError if there is no dataset with this name
  std::vector<double> read(std::size_t analysis, const std::string& dataset) const;
  std::vector<ResultsColumn> columns() const { return rows_.columns(); }
  std::optional<ResultsColumn> find(const std::string& dataset) const { return rows_.find(dataset); }
  std::size_t row_size() const { return rows_.size(); }  ///< number of values in a row, without the time

  void begin_analysis(const std::string& type, std::size_t expected_rows) override;
  void record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
              const StepRecord& step) override;
  void write(const ResultArray& array) override;
  void write(const ResultNames& names) override { analyses_.back().names[names.dataset] = names.names; }
  void write(const EntryNumbers& numbers) override;
  void note(const Event& event) override { analyses_.back().events.push_back(event); }
  void end_analysis() override {}

 private:
  ResultsRows rows_;
  std::vector<Recorded> analyses_;
};

}  // namespace bielle::mechanism
