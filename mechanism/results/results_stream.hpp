// Takes the results of a run off its hands: the run leaves a copy of its state, a second thread makes the row of it,
// lays out the file and writes.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mechanism/model/state.hpp"
#include "mechanism/results/results_rows.hpp"
#include "reduce/common/files/checksum.hpp"
#include "reduce/common/files/hdf5_file.hpp"

namespace bielle::mechanism {

/// Two queues of states take turns: the run fills one while the writing thread empties the other. Members below `guard`
/// are guarded by it. The others belong to the writing thread as long as rows wait, and to the run once it has waited
/// for them to be written.
class ResultsStream {
 public:
  /// @param layout  nothing: what suits the size of the model
  ResultsStream(Hdf5File results, const Model& model, std::optional<ResultsLayout> layout);
  /// Writes what waits.
  ~ResultsStream();
  ResultsStream(const ResultsStream&) = delete;
  ResultsStream& operator=(const ResultsStream&) = delete;

  void start();  ///< from here on a thread writes
  /// Opens an analysis's group. @param expected_rows  0 when unknown
  void begin(const std::string& group, std::size_t expected_rows);
  /// Goes on with the rows of an analysis that the file holds already. @throws InputError when it lacks one
  void resume(const std::string& group, std::size_t recorded);
  /// Changes nothing in the file. @throws InputError when that analysis has other datasets than this run would write
  void check_datasets(const std::string& group);
  /// After check_datasets. @throws InputError when the first rows of that analysis are not those that were written
  void check_rows(std::size_t rows, std::int64_t sum);
  /// Copies a row's state. Waits while both queues are full. @throws what an earlier row failed with
  /// @param slots  of the model's members; must outlive the analysis
  void record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
              const StepRecord& step);
  void wait_until_all_is_written();
  void link_from_root();

  // After wait_until_all_is_written:
  Hdf5File& file() { return file_; }
  ResultsRows& rows() { return rows_; }
  const Model& model() const { return model_; }
  ResultsLayout layout() const { return layout_; }
  const std::string& group() const { return group_; }
  std::size_t recorded() const { return recorded_; }  ///< rows of the running analysis
  std::int64_t sum_of_rows() const;                   ///< a checksum of these

 private:
  /// What a row is made of.
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
  /// Rows on their way to the file.
  struct Block {
    std::vector<double> times;
    std::vector<double> values;  ///< row after row
    std::size_t rows = 0;
  };
  std::size_t row_bytes() const { return sizeof(double) * (rows_.size() + 1); }
  void make_room(const State& state);
  void prepare_columns();
  void create_columns();
  /// Makes rows of states from number `first` of the queue on, as many as the block takes. @returns how many
  std::size_t make_rows(std::size_t first);
  void add_to_sums();
  void write_block();
  void write_until_told_to_stop();
  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  const Model& model_;
  ResultsRows rows_;
  ResultsLayout layout_;
  Hdf5File file_;
  std::string group_;  ///< of the running analysis
  std::size_t expected_rows_ = 0, recorded_ = 0;
  std::vector<ResultsColumn> columns_;
  std::vector<std::string> datasets_;  ///< of the columns, with the group
  std::string time_dataset_;
  bool created_ = false, linked_ = false;
  std::vector<Checksum> sums_;  ///< of the rows of each dataset, of the times last; empty: of a file without
  Queue taken_;
  Block block_;
  std::vector<ResultsInstant> views_;  ///< of the states that rows are made of
  std::vector<double> together_;       ///< the rows of one column, as its dataset takes them

  std::mutex guard_;
  std::condition_variable changed_;
  Queue filling_;
  std::size_t waiting_ = 0;  ///< rows that are not in the file yet
  bool wanted_now_ = false, stopping_ = false;
  std::exception_ptr failure_;  ///< of the writing thread
  std::thread writer_;
};

}  // namespace bielle::mechanism
