#include "mechanism/io/results_file.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "mechanism/io/results_rows.hpp"
#include "reduce/common/hdf5_file.hpp"

namespace bielle::mechanism {

namespace {

constexpr std::int64_t results_version = 1;
// Rows wait in memory at most so long [s]: shorter flushes cost more than they save.
constexpr std::chrono::milliseconds longest_wait{200};
// Rows are written in blocks of at most so many bytes and rows.
constexpr std::size_t block_bytes = std::size_t{4} << 20, most_block_rows = 512;
// The file grows by so many bytes of results, or by less when the number of rows is known.
constexpr std::size_t known_growth_bytes = std::size_t{1} << 30, unknown_growth_bytes = std::size_t{4} << 20;
constexpr std::size_t most_growth_rows = std::size_t{1} << 20, unknown_growth_rows = 8192;

/// Rows of `row_bytes` that fit, at least one.
std::size_t rows_in(std::size_t bytes, std::size_t row_bytes, std::size_t most) {
  return std::clamp<std::size_t>(bytes / row_bytes, 1, most);
}

}  // namespace

struct ResultsFile::Stream {
  Stream(const std::string& path, const Model& model)
      : rows(model),
        row_bytes(sizeof(double) * (rows.size() + 1)),
        block_rows(rows_in(block_bytes, row_bytes, most_block_rows)),
        file(Hdf5File::create(path)) {}

  void create_datasets();
  void write_block();
  void link_from_root();
  void write_waiting_until_told_to_stop();
  void rethrow_failure() {
    if (failure) std::rethrow_exception(failure);
  }

  // Everything below but `writer` is guarded by `guard`.
  ResultsRows rows;
  const std::size_t row_bytes, block_rows;
  Hdf5File file;
  int analysis = 0;
  std::size_t expected_rows = 0;
  std::string group;                  ///< of the running analysis
  std::vector<std::string> datasets;  ///< of the columns; empty before the first row of the running analysis
  std::string time_dataset;
  bool linked = false;         ///< the running analysis from the root
  std::vector<double> times;   ///< (block_rows)
  std::vector<double> block;   ///< each column's rows one after the other: what a dataset takes in one piece
  std::vector<double> row;     ///< one row
  std::size_t waiting = 0;     ///< rows in the block
  std::exception_ptr failure;  ///< of the writing thread, told at the next call
  bool stopping = false;
  std::mutex guard;
  std::condition_variable woken;
  std::thread writer;
};

void ResultsFile::Stream::create_datasets() {
  const std::size_t chunk_rows = expected_rows > 0
                                     ? rows_in(known_growth_bytes, row_bytes, std::min(expected_rows, most_growth_rows))
                                     : rows_in(unknown_growth_bytes, row_bytes, unknown_growth_rows);
  const auto units_or_number = [](const std::string& units) { return units.empty() ? std::string("-") : units; };
  for (const ResultsColumn& column : rows.columns()) {
    datasets.push_back(group + "/" + column.dataset);
    file.create_rows(datasets.back(), column.shape, units_or_number(column.units), column.description, chunk_rows);
  }
  for (const ResultsGroup& described : rows.groups()) {
    file.make_group(group + "/" + described.name);
    for (const auto& [name, value] : described.attributes)
      file.write_attribute(group + "/" + described.name, name, value);
  }
  time_dataset = group + "/time";
  file.create_rows(time_dataset, {}, "s", "row 0 is the start; rows of other datasets beyond these do not count",
                   expected_rows > 0 ? std::min(expected_rows, most_growth_rows) : unknown_growth_rows);
  times.resize(block_rows);
  block.resize(block_rows * rows.size());
  row.resize(rows.size());
  rows.restart();
}

void ResultsFile::Stream::write_block() {
  if (waiting == 0) return;
  const std::size_t count = std::exchange(waiting, 0);
  for (std::size_t k = 0; k < datasets.size(); ++k) {
    const ResultsColumn& column = rows.columns()[k];
    file.append_rows(datasets[k], {block.data() + block_rows * column.begin, count * column.size}, count);
  }
  file.flush();
  file.append_rows(time_dataset, {times.data(), count}, count);
  file.flush();
  if (!linked) link_from_root();
}

void ResultsFile::Stream::link_from_root() {
  for (const std::string& name : file.names_in(group)) file.link(group + "/" + name, "/" + name);
  file.flush();
  linked = true;
}

void ResultsFile::Stream::write_waiting_until_told_to_stop() {
  std::unique_lock lock(guard);
  while (!stopping) {
    woken.wait_for(lock, longest_wait);
    try {
      if (!failure) write_block();
    } catch (...) {
      failure = std::current_exception();
    }
  }
}

ResultsFile::ResultsFile(const std::string& path, const Model& model, const std::string& input_text)
    : stream_(std::make_unique<Stream>(path, model)) {
  Hdf5File& file = stream_->file;
  file.write_attribute("/", "format", std::string("bielle results"));
  file.write_attribute("/", "version", results_version);
  file.write_attribute("/", "name", model.title);
  file.write_attribute("/", "created_by", std::string("bielle-mechanism ") + BIELLE_VERSION);
  file.write_attribute("/", "complete", std::int64_t{0});
  file.write_text("/input", input_text);
  file.flush();
  stream_->writer = std::thread([stream = stream_.get()] { stream->write_waiting_until_told_to_stop(); });
}

ResultsFile::~ResultsFile() {
  {
    const std::lock_guard lock(stream_->guard);
    stream_->stopping = true;
  }
  stream_->woken.notify_one();
  stream_->writer.join();
  try {
    if (!stream_->failure) stream_->write_block();
  } catch (const std::exception&) {
    // Whoever ends a run in this way has an error of his own to tell.
  }
}

void ResultsFile::begin_analysis(const std::string& type, std::size_t expected_rows) {
  const std::lock_guard lock(stream_->guard);
  stream_->rethrow_failure();
  stream_->write_block();
  stream_->group = fmt::format("/analysis_{}", ++stream_->analysis);
  stream_->datasets.clear();
  stream_->linked = false;
  stream_->expected_rows = expected_rows;
  stream_->file.make_group(stream_->group);
  stream_->file.write_attribute(stream_->group, "type", type);
}

void ResultsFile::record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                         const StepRecord& step) {
  Stream& stream = *stream_;
  const std::lock_guard lock(stream.guard);
  stream.rethrow_failure();
  if (stream.group.empty()) throw std::logic_error("a row of results outside of an analysis");
  if (stream.datasets.empty()) stream.create_datasets();
  stream.rows.fill(state, slots, environment, step, stream.row.data());
  for (const ResultsColumn& column : stream.rows.columns())
    std::copy_n(stream.row.data() + column.begin, column.size,
                stream.block.data() + stream.block_rows * column.begin + stream.waiting * column.size);
  stream.times[stream.waiting++] = state.time;
  if (stream.waiting == stream.block_rows) stream.write_block();
}

void ResultsFile::end_analysis() {
  const std::lock_guard lock(stream_->guard);
  stream_->rethrow_failure();
  stream_->write_block();
  stream_->link_from_root();  // also what was written beside the rows
}

void ResultsFile::complete() {
  const std::lock_guard lock(stream_->guard);
  stream_->rethrow_failure();
  stream_->write_block();
  stream_->file.write_attribute("/", "complete", std::int64_t{1});
  stream_->file.close();
}

Hdf5File& ResultsFile::file() { return stream_->file; }
std::string ResultsFile::analysis_group() const { return stream_->group; }

}  // namespace bielle::mechanism
