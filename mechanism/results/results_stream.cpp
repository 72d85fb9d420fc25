#include "mechanism/results/results_stream.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "mechanism/results/results_datasets.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

namespace {

using Clock = std::chrono::steady_clock;

// Longest time that rows wait in memory; if writing takes long (thousands of datasets), they wait for this multiple of
// its time.
constexpr std::chrono::milliseconds longest_wait{200}, wait_of_large_models{2000};
constexpr int wait_per_writing = 10;
// Largest size of a queue of states, in bytes and states; the writing thread starts when half a queue is full.
constexpr std::size_t queue_bytes = std::size_t{8} << 20, most_queued = 128;
// Largest size of a block of rows, in bytes and rows.
constexpr std::size_t block_bytes = std::size_t{32} << 20, most_block_rows = 512;
// Rows of a column with at least this number of values are written one by one: a call costs less than copying them
// together.
constexpr std::size_t large_column = 8192;
// Growth of the file in bytes of results; it is smaller if the number of rows is known.
constexpr std::size_t known_growth_bytes = std::size_t{1} << 30, unknown_growth_bytes = std::size_t{4} << 20;
constexpr std::size_t most_growth_rows = std::size_t{1} << 20, unknown_growth_rows = 8192;

/// Returns the number of pieces of `piece` bytes that fit, at least one.
std::size_t pieces_in(std::size_t bytes, std::size_t piece, std::size_t most) {
  return std::clamp<std::size_t>(bytes / piece, 1, most);
}

std::size_t bytes_of(const State& state) {
  const auto numbers =
      3 * state.amplitude.size() + 2 * state.first_order.size() + state.multiplier.size() + state.memory.size();
  return sizeof(State) + sizeof(NodeState) * state.nodes.size() + sizeof(double) * static_cast<std::size_t>(numbers);
}

}  // namespace

ResultsStream::ResultsStream(Hdf5File results, const Model& model, std::optional<ResultsLayout> layout)
    : model_(model),
      rows_(model),
      largest_(rows_.kinds()),
      layout_(layout_for(rows_, layout)),
      file_(std::move(results)) {}

// -- the run's side

void ResultsStream::start() {
  writer_ = std::thread([this] { write_until_told_to_stop(); });
}

ResultsStream::~ResultsStream() {
  {
    const std::lock_guard lock(guard_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (writer_.joinable()) writer_.join();
}

void ResultsStream::begin(const std::string& group, std::size_t expected_rows) {
  group_ = group;
  expected_rows_ = expected_rows;
  recorded_ = written_ = 0;
  prepared_ = created_ = linked_ = false;
  sums_.clear();
}

void ResultsStream::resume(const std::string& group, std::size_t recorded) {
  std::vector<Checksum> sums = std::move(sums_);
  begin(group, 0);
  sums_ = std::move(sums);
  recorded_ = written_ = recorded;
  prepare_columns();
  prepared_ = created_ = true;
  link_from_root();
}

void ResultsStream::check_datasets(const std::string& group) {
  begin(group, 0);
  prepare_columns();
  check_same_datasets(file_, group_, model_, rows_, layout_, columns_);
}

void ResultsStream::check_rows(std::size_t rows, std::int64_t sum) {
  sums_.assign(datasets_.size() + 1, {});
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const std::size_t size = k < columns_.size() ? columns_[k].size : 1;
    const std::size_t together = pieces_in(block_bytes, sizeof(double) * std::max<std::size_t>(size, 1), rows);
    for (std::size_t first = 0; first < rows; first += together)
      sums_[k].add(
          file_.read_rows(k < columns_.size() ? datasets_[k] : time_dataset_, first, std::min(together, rows - first)));
  }
  if (sum_of_rows() != sum)
    throw InputError(fmt::format(
        "{}: {}: its first {} are not those that were written: the file is damaged, or was changed; run anew",
        file_.path(), group_, counted(rows, "row")));
}

std::int64_t ResultsStream::sum_of_rows() const {
  Checksum all;
  for (const Checksum& sum : sums_) all.add(static_cast<double>(sum.value()));
  return all.value();
}

void ResultsStream::record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                           const StepRecord& step) {
  if (group_.empty()) throw std::logic_error("a row of results outside of an analysis");
  std::unique_lock lock(guard_);
  changed_.wait(lock,
                [&] { return failure_ || filling_.instants.empty() || filling_.count < filling_.instants.size(); });
  check();
  if (filling_.instants.empty())
    for (Queue* queue : {&filling_, &taken_})
      queue->instants.resize(pieces_in(queue_bytes, bytes_of(state), most_queued));
  Instant& instant = filling_.instants[filling_.count++];
  instant.state = state;
  instant.slots = &slots;
  instant.environment = environment;
  instant.step = step;
  ++recorded_;
  ++waiting_;
  const std::size_t size = filling_.instants.size();
  if (filling_.count == size || 2 * filling_.count == size) changed_.notify_all();
}

void ResultsStream::wait_until_all_is_written() {
  std::unique_lock lock(guard_);
  wanted_now_ = true;
  changed_.notify_all();
  changed_.wait(lock, [&] { return failure_ || waiting_ == 0; });
  wanted_now_ = false;
  check();
}

// -- the writing thread

void ResultsStream::write_until_told_to_stop() {
  std::unique_lock lock(guard_);
  Clock::duration wait = longest_wait;
  auto written = Clock::now();
  const auto wanted = [&] {
    return stopping_ || (!failure_ && waiting_ > 0 && (wanted_now_ || 2 * filling_.count >= filling_.instants.size()));
  };
  while (true) {
    changed_.wait_until(lock, written + wait, wanted);
    if (failure_) {
      if (stopping_) return;
      written = Clock::now();  // after a failure no more rows are written
      continue;
    }
    const bool at_once = stopping_ || wanted_now_;
    std::swap(filling_, taken_);
    filling_.count = 0;
    lock.unlock();
    changed_.notify_all();
    std::exception_ptr failed;
    std::size_t done = 0;
    try {
      for (std::size_t k = 0; k < taken_.count;) {
        k += make_rows(k);
        if (block_.rows < block_.times.size()) continue;
        done += block_.rows;
        write_block();
      }
      const auto now = Clock::now();
      if (block_.rows > 0 && (at_once || now >= written + wait)) {
        done += block_.rows;
        write_block();
        wait = std::clamp<Clock::duration>(wait_per_writing * (Clock::now() - now), longest_wait, wait_of_large_models);
      }
      if (block_.rows == 0) written = Clock::now();
    } catch (...) {
      failed = std::current_exception();
    }
    taken_.count = 0;
    lock.lock();
    waiting_ -= done;
    if (failed) failure_ = failed;
    changed_.notify_all();
    if (stopping_ && filling_.count == 0) return;
  }
}

std::size_t ResultsStream::make_rows(std::size_t first) {
  if (!prepared_) {
    prepare_columns();
    rows_.restart();
    sums_.assign(datasets_.size() + 1, {});
    prepared_ = true;
  }
  if (block_.times.empty()) {
    block_.times.resize(pieces_in(block_bytes, row_bytes(), most_block_rows));
    block_.values = std::make_unique_for_overwrite<double[]>(block_.times.size() * rows_.size());
  }
  const std::size_t count = std::min(taken_.count - first, block_.times.size() - block_.rows);
  views_.clear();
  for (std::size_t k = first; k < first + count; ++k) {
    const Instant& instant = taken_.instants[k];
    views_.push_back({&instant.state, instant.slots, &instant.environment, &instant.step});
    block_.times[block_.rows + k - first] = instant.step.time.value_or(instant.state.time);
  }
  rows_.fill(views_, block_.values.get() + block_.rows * rows_.size());
  for (std::size_t row = block_.rows; row < block_.rows + count; ++row)
    largest_.add(block_.times[row], block_.values.get() + row * rows_.size());
  block_.rows += count;
  return count;
}

/// Adds the waiting rows to the sums, row by row: the processor works on several columns at a time.
void ResultsStream::add_to_sums() {
  if (sums_.empty()) return;
  for (std::size_t row = 0; row < block_.rows; ++row) {
    const double* numbers = block_.values.get() + row * rows_.size();
    for (std::size_t k = 0; k < columns_.size(); ++k) sums_[k].add({numbers + columns_[k].begin, columns_[k].size});
  }
  sums_.back().add({block_.times.data(), block_.rows});
}

/// The file never counts an incomplete row, because the data are written before the times. The datasets are created
/// with the first rows, and the flush brings all these changes to the file together. They are closed with the last
/// expected rows, because an open dataset holds some 20 kB.
void ResultsStream::write_block() {
  add_to_sums();
  written_ += block_.rows;
  const bool creates = !created_, last = written_ >= expected_rows_ && expected_rows_ > 0;
  if (creates) file_.hold_back(true);
  for (std::size_t k = 0; k < datasets_.size(); ++k) {
    if (creates) create_dataset(file_, group_, columns_[k], chunk_rows_);
    append_column(k);
    if (last) file_.close_rows(datasets_[k]);
  }
  if (creates) {
    describe_entries(file_, group_, rows_, layout_);
    file_.create_rows(time_dataset_, {}, "s", "row 0 is the start; rows of other datasets beyond these do not count",
                      expected_rows_ > 0 ? std::min(expected_rows_, most_growth_rows) : unknown_growth_rows);
  }
  file_.flush();
  if (creates) file_.hold_back(false);
  created_ = true;
  file_.append_rows(time_dataset_, {block_.times.data(), block_.rows}, block_.rows);
  file_.flush();
  block_.rows = 0;
  if (!linked_) link_from_root();
}

void ResultsStream::append_column(std::size_t number) {
  const ResultsColumn& column = columns_[number];
  const double* first = block_.values.get() + column.begin;
  if (block_.rows == 1 || column.size >= large_column) {
    for (std::size_t row = 0; row < block_.rows; ++row)
      file_.append_rows(datasets_[number], {first + row * rows_.size(), column.size});
    return;
  }
  together_.resize(block_.rows * column.size);
  for (std::size_t row = 0; row < block_.rows; ++row)
    std::copy_n(first + row * rows_.size(), column.size, together_.data() + row * column.size);
  file_.append_rows(datasets_[number], together_, block_.rows);
}

// -- the datasets of an analysis

void ResultsStream::prepare_columns() {
  if (columns_.empty()) columns_ = rows_.columns(layout_);
  datasets_.clear();
  for (const ResultsColumn& column : columns_) datasets_.push_back(group_ + "/" + column.dataset);
  time_dataset_ = group_ + "/time";
  const std::size_t known = std::min(expected_rows_, most_growth_rows);
  chunk_rows_ = known > 0 ? pieces_in(known_growth_bytes, row_bytes(), known)
                          : pieces_in(unknown_growth_bytes, row_bytes(), unknown_growth_rows);
}

void ResultsStream::link_from_root() {
  for (const std::string& name : file_.names_in(group_)) file_.link(group_ + "/" + name, "/" + name);
  file_.flush();
  linked_ = true;
}

}  // namespace bielle::mechanism
