// Streams a run to its HDF5 results file. The format is described in mechanism/io/README.md.
//
// The run hands over copies of its state; a second thread makes rows of them and writes these in blocks, `/time` last:
// whatever happens to the program, the file is readable and every row that its `/time` counts is whole. Nothing waits
// for longer than 0.2 s (up to 2 s where thousands of datasets take long to write), so that completed steps reach the
// file in time also while the next one is slow.
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
  /// @param layout      nothing: by names, or stacked where there would be too many datasets
  /// @throws ComputationError when the file cannot be created
  ResultsFile(const std::string& path, const Model& model, const std::string& input_text,
              std::optional<ResultsLayout> layout = {});
  /// Goes on with an existing file from a checkpoint: what came after it is taken out. The analysis of the checkpoint
  /// is the running one. @param layout  nothing: that of the file
  /// @throws InputError when the file has another layout, or other outputs
  ResultsFile(const std::string& path, const Model& model, const std::string& input_text, const Checkpoint& checkpoint,
              std::optional<ResultsLayout> layout = {});
  ~ResultsFile()
      override;  ///< writes the rows that wait; the file stays `complete = false` unless complete() was called

  /// Writes /equations: the name of each equation with its units, one per line, for those that rows name by number.
  void name_equations(const System& system);

  /// Opens the group /analysis_1, /analysis_2, ...
  /// @param type  as in the input file: "dynamic"
  /// @param expected_rows  how many rows will follow, 0 when unknown. A good guess lets each dataset be stored in one
  ///        piece, so that no moment is a bad one to be killed in (see Hdf5File::create_rows).
  void begin_analysis(const std::string& type, std::size_t expected_rows = 0) override;

  /// Adds a row. No memory is allocated but for the first one. Components are asked for their outputs in another
  /// thread, a moment later.
  /// @param slots  of the model's members, in their order; they must outlive the analysis
  /// @throws ComputationError when this or an earlier row could not be written (a full disk)
  void record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
              const StepRecord& step) override;

  /// A dataset of the running analysis, besides its rows.
  void write(const ResultArray& array) override;
  void write(const ResultNames& names) override;
  void write(const EntryNumbers& numbers) override;
  /// Appends to /analysis_k/events.
  void note(const Event& event) override;

  /// Writes the rows that wait and, after them, a point to go on from. @param archive  with all of it but what belongs
  /// to the file itself
  void checkpoint(Archive& archive) override;
  /// A table of steps that belongs to the run: a run that goes on cuts it where it goes on. It must outlive the run.
  void keep_with(StepLog& log) { log_ = &log; }
  /// What rows to come take from those before.
  void exchange(Archive& archive) override;
  /// Writes the rows that wait and links the analysis's groups from the root.
  void end_analysis() override;
  void complete() override;  ///< marks the file `complete = true` and closes it

  /// The file, free to be written between begin_analysis and end_analysis while no row is waiting, and the path of the
  /// running analysis's group.
  Hdf5File& file();
  std::string analysis_group() const;

 private:
  std::unique_ptr<ResultsStream> stream_;
  int analysis_ = 0;  ///< number of the running one
  long events_ = 0;   ///< of the running analysis
  StepLog* log_ = nullptr;
};

}  // namespace bielle::mechanism
