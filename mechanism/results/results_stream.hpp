// Writes the results of a run in a second thread: the run passes a copy of its state; the thread computes the row,
// creates the datasets and writes.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mechanism/model/state.hpp"
#include "mechanism/results/largest_values.hpp"
#include "mechanism/results/results_rows.hpp"
#include "reduce/common/files/checksum.hpp"
#include "reduce/common/files/hdf5_file.hpp"

namespace bielle::mechanism {

/// Two queues of states are used alternately: the run fills one while the writing thread empties the other. The members
/// below `guard` are protected by it. The others belong to the writing thread while rows wait, and to the run after it
/// has waited for them to be written.
class ResultsStream {
 public:
  /// @param layout  empty: chosen by the size of the model
  ResultsStream(Hdf5File results, const Model& model, std::optional<ResultsLayout> layout);
  /// Writes the waiting rows.
  ~ResultsStream();
  ResultsStream(const ResultsStream&) = delete;
  ResultsStream& operator=(const ResultsStream&) = delete;

  void start();  ///< starts the writing thread
  /// Opens an analysis's group. @param expected_rows  0 if unknown
  void begin(const std::string& group, std::size_t expected_rows);
  /// Continues the rows of an analysis that the file already contains. @throws InputError if a row is missing
  void resume(const std::string& group, std::size_t recorded);
  /// Checks the datasets of an analysis; changes nothing in the file. @throws InputError if that analysis has other
  /// datasets than this run would write
  void check_datasets(const std::string& group);
  /// Checks the first rows; call it after check_datasets. @throws InputError if the first rows of that analysis are not
  /// those that were written
  void check_rows(std::size_t rows, std::int64_t sum);
  /// Copies a row's state. It waits while both queues are full. @throws the exception of an earlier row that failed
  /// @param slots  slots of the model's members; they must outlive the analysis
  void record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
              const StepRecord& step);
  void wait_until_all_is_written();
  void link_from_root();

  // The following functions may be called after wait_until_all_is_written:
  Hdf5File& file() { return file_; }
  ResultsRows& rows() { return rows_; }
  LargestValues& largest() { return largest_; }  ///< largest values in rows of the open analysis
  const Model& model() const { return model_; }
  ResultsLayout layout() const { return layout_; }
  const std::string& group() const { return group_; }
  std::size_t recorded() const { return recorded_; }  ///< number of rows of the open analysis
  std::int64_t sum_of_rows() const;                   ///< a checksum of these rows

 private:
  /// The data that a row is computed from.
  struct Instant {
    State state;
    const std::vector<Slots>* slots = nullptr;
    Environment environment;
    StepRecord step;
  };
  struct Queue {
    std::vector<Instant> instants;
    std::size_t count = 0;
  };
  /// Rows that are to be written to the file.
  struct Block {
    std::vector<double> times;
    std::unique_ptr<double[]> values;  ///< row after row; memory that no row has reached is never touched
    std::size_t rows = 0;
  };
  std::size_t row_bytes() const { return sizeof(double) * (rows_.size() + 1); }
  void prepare_columns();
  /// Computes rows from the states of the queue from number `first` on, as many as fit in the block. @returns their
  /// number
  std::size_t make_rows(std::size_t first);
  void add_to_sums();
  void write_block();
  void append_column(std::size_t number);  ///< appends the block's rows of a column
  void write_until_told_to_stop();
  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  const Model& model_;
  ResultsRows rows_;
  LargestValues largest_;
  ResultsLayout layout_;
  Hdf5File file_;
  std::string group_;                                           ///< group of the open analysis
  std::size_t expected_rows_ = 0, recorded_ = 0, written_ = 0;  ///< numbers of rows
  std::size_t chunk_rows_ = 1;
  std::vector<ResultsColumn> columns_;
  std::vector<std::string> datasets_;  ///< paths of the columns, including the group
  std::string time_dataset_;
  bool prepared_ = false, created_ = false, linked_ = false;
  std::vector<Checksum> sums_;  ///< checksums of the rows of each dataset, the times last; empty if the file has none
  Queue taken_;
  Block block_;
  std::vector<ResultsInstant> views_;  ///< views of the states that rows are computed from
  std::vector<double> together_;       ///< the rows of one column, in the order of its dataset

  std::mutex guard_;
  std::condition_variable changed_;
  Queue filling_;
  std::size_t waiting_ = 0;  ///< number of rows that are not yet in the file
  bool wanted_now_ = false, stopping_ = false;
  std::exception_ptr failure_;  ///< exception of the writing thread
  std::thread writer_;
};

}  // namespace bielle::mechanism
