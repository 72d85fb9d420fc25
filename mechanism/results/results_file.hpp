// Writes a run to its HDF5 results file. The format is described in mechanism/io/README.md.
//
// The run passes copies of its state; a second thread computes rows from them and writes these in blocks, `/time` last:
// even if the program crashes, the file is readable and every row counted in its `/time` is complete. No row waits for
// longer than 0.2 s (up to 2 s if writing takes long because of thousands of datasets), so that completed steps reach
// the file in time even while the next one is slow.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/results/checkpoint.hpp"
#include "mechanism/results/result_sink.hpp"
#include "mechanism/results/results_rows.hpp"

namespace bielle {
class Hdf5File;
}

namespace bielle::mechanism {

class Model;
class ResultsStream;
class StepLog;
class System;

class ResultsFile : public ResultSink {
 public:
  /// Replaces an existing file. The model must outlive this object.
  /// @param input_text  text of the mechanism file
  /// @param layout      empty: by names, or stacked if there would be too many datasets
  /// @throws ComputationError if the file cannot be created
  ResultsFile(const std::string& path, const Model& model, const std::string& input_text,
              std::optional<ResultsLayout> layout = {});
  /// Continues an existing file from a checkpoint: everything written after it is removed. The analysis of the
  /// checkpoint is then the open one. @param layout  empty: the layout of the file
  /// @throws InputError if the file has another layout, or other outputs
  ResultsFile(const std::string& path, const Model& model, const std::string& input_text, const Checkpoint& checkpoint,
              std::optional<ResultsLayout> layout = {});
  ~ResultsFile() override;  ///< writes the waiting rows; `complete` stays false without complete()

  /// Writes /equations: the name of each equation with its units, one per line, for equations that rows identify by
  /// number.
  void name_equations(const System& system);

  /// Opens the group /analysis_1, /analysis_2, ...
  /// @param type  as in the input file: "dynamic"
  /// @param expected_rows  expected number of rows, 0 if unknown. A good estimate allows each dataset to be stored
  ///        contiguously, so that the file is valid whenever the program is killed (see
  ///        Hdf5File::create_rows)
  void begin_analysis(const std::string& type, std::size_t expected_rows = 0) override;

  /// Adds a row. Memory is allocated only for the first row. Components compute their outputs in another thread,
  /// shortly afterwards.
  /// @param slots  slots of the model's members, in their order; they must outlive the analysis
  /// @throws ComputationError if this or an earlier row could not be written (a full disk)
  void record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
              const StepRecord& step) override;

  /// Writes a dataset of the open analysis that is not a row.
  void write(const ResultArray& array) override;
  void write(const ResultNames& names) override;
  void write(const EntryNumbers& numbers) override;
  /// Appends to /analysis_k/events.
  void note(const Event& event) override;

  /// Writes the waiting rows and, after them, a checkpoint. @param archive  contains the whole checkpoint except the
  /// file's own part
  void checkpoint(Archive& archive) override;
  /// Registers a table of steps that belongs to the run: a continued run truncates it at the checkpoint. The table must
  /// outlive the run.
  void keep_with(StepLog& log) { log_ = &log; }
  /// Exchanges the data of earlier rows that later rows depend on.
  void exchange(Archive& archive) override;
  /// Writes the waiting rows and links the analysis's groups from the root.
  void end_analysis() override;
  /// Lines about the largest forces, stresses and pressures of the last analysis' rows; empty without any.
  std::string largest_values();
  void complete() override;  ///< marks the file `complete = true` and closes it

  /// Returns the file, which may be written between begin_analysis and end_analysis while no row is waiting, and the
  /// path of the open analysis's group.
  Hdf5File& file();
  std::string analysis_group() const;

 private:
  std::unique_ptr<ResultsStream> stream_;
  int analysis_ = 0;  ///< number of the open analysis
  long events_ = 0;   ///< number of events of the open analysis
  StepLog* log_ = nullptr;
};

}  // namespace bielle::mechanism
