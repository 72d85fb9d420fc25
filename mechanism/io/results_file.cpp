#include "mechanism/io/results_file.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "mechanism/io/results_rows.hpp"
#include "mechanism/system/system.hpp"
#include "reduce/common/hdf5_file.hpp"

namespace bielle::mechanism {

namespace {

constexpr std::int64_t results_version = 1;
// Rows wait in memory at most so long, or, where writing takes longer (thousands of datasets), so many times as long as
// that.
constexpr std::chrono::milliseconds longest_wait{200}, wait_of_large_models{2000};
constexpr int wait_per_writing = 10;
// Rows are written in blocks of at most so many bytes and rows.
constexpr std::size_t block_bytes = std::size_t{32} << 20, most_block_rows = 512;
// The file grows by so many bytes of results, or by less when the number of rows is known.
constexpr std::size_t known_growth_bytes = std::size_t{1} << 30, unknown_growth_bytes = std::size_t{4} << 20;
constexpr std::size_t most_growth_rows = std::size_t{1} << 20, unknown_growth_rows = 8192;

/// Rows of `row_bytes` that fit, at least one.
std::size_t rows_in(std::size_t bytes, std::size_t row_bytes, std::size_t most) {
  return std::clamp<std::size_t>(bytes / row_bytes, 1, most);
}

/// Rows on their way to the file.
struct Block {
  std::vector<double> times;
  std::vector<double> values;  ///< row after row
  std::size_t rows = 0;
};

}  // namespace

/// Two blocks take turns: the run fills one while the writing thread, alone, writes the other. Members below `guard`
/// are guarded by it; `file` and `writing` belong to the writing thread while it is busy and to the run otherwise.
struct ResultsFile::Stream {
  Stream(Hdf5File results, const Model& results_model)
      : model(results_model),
        rows(model),
        row_bytes(sizeof(double) * (rows.size() + 1)),
        block_rows(rows_in(block_bytes, row_bytes, most_block_rows)),
        file(std::move(results)) {}

  void start(const std::string& input_text);
  void prepare_rows();
  void create_datasets();
  void write(const Block& block);
  void link_from_root();

  void write_until_told_to_stop();
  void wait_until_all_is_written();
  void check() const {
    if (failure) std::rethrow_exception(failure);
  }

  const Model& model;
  ResultsRows rows;
  const std::size_t row_bytes, block_rows;
  Hdf5File file;
  std::vector<double> together;  ///< the rows of one column, as its dataset takes them
  Block writing;
  int analysis = 0;  // the running one, and its
  std::string group;
  std::size_t expected_rows = 0, recorded = 0;
  std::vector<std::string> datasets;  ///< of the columns; empty before the first row
  std::string time_dataset;
  bool linked = false;

  std::mutex guard;
  std::condition_variable changed;
  Block filling;
  bool busy = false, wanted_now = false, stopping = false;
  std::exception_ptr failure;  ///< of the writing thread
  std::thread writer;
};

// -- the datasets of an analysis

void ResultsFile::Stream::create_datasets() {
  const std::size_t known = std::min(expected_rows, most_growth_rows);
  const std::size_t chunk_rows = known > 0 ? rows_in(known_growth_bytes, row_bytes, known)
                                           : rows_in(unknown_growth_bytes, row_bytes, unknown_growth_rows);
  prepare_rows();
  const auto units_or_number = [](const std::string& units) { return units.empty() ? std::string("-") : units; };
  for (std::size_t k = 0; k < datasets.size(); ++k) {
    const ResultsColumn& column = rows.columns()[k];
    file.create_rows(datasets[k], column.shape, units_or_number(column.units), column.description, chunk_rows);
  }
  for (const ResultsGroup& described : rows.groups()) {
    file.make_group(group + "/" + described.name);
    for (const auto& [name, value] : described.attributes)
      file.write_attribute(group + "/" + described.name, name, value);
  }
  file.create_rows(time_dataset, {}, "s", "row 0 is the start; rows of other datasets beyond these do not count",
                   known > 0 ? known : unknown_growth_rows);
  rows.restart();
}

void ResultsFile::Stream::prepare_rows() {
  for (const ResultsColumn& column : rows.columns()) datasets.push_back(group + "/" + column.dataset);
  time_dataset = group + "/time";
  for (Block* block : {&filling, &writing}) {
    block->times.resize(block_rows);
    block->values.resize(block_rows * rows.size());
  }
}

/// The file never counts a row that is not whole: first the data, then the times.
void ResultsFile::Stream::write(const Block& block) {
  for (std::size_t k = 0; k < datasets.size(); ++k) {
    const ResultsColumn& column = rows.columns()[k];
    together.resize(block.rows * column.size);
    for (std::size_t row = 0; row < block.rows; ++row)
      std::copy_n(block.values.data() + row * rows.size() + column.begin, column.size,
                  together.data() + row * column.size);
    file.append_rows(datasets[k], together, block.rows);
  }
  file.flush();
  file.append_rows(time_dataset, {block.times.data(), block.rows}, block.rows);
  file.flush();
  if (!linked) link_from_root();
}

void ResultsFile::Stream::link_from_root() {
  for (const std::string& name : file.names_in(group)) file.link(group + "/" + name, "/" + name);
  file.flush();
  linked = true;
}

// -- the writing thread

void ResultsFile::Stream::write_until_told_to_stop() {
  std::unique_lock lock(guard);
  std::chrono::steady_clock::duration wait = longest_wait;
  while (true) {
    changed.wait_for(lock, wait,
                     [&] { return stopping || (!failure && filling.rows >= (wanted_now ? 1 : block_rows)); });
    if (filling.rows > 0 && !failure) {
      std::swap(filling, writing);
      busy = true;
      changed.notify_all();
      lock.unlock();
      std::exception_ptr failed;
      const auto start = std::chrono::steady_clock::now();
      try {
        write(writing);
      } catch (...) {
        failed = std::current_exception();
      }
      wait = std::clamp<std::chrono::steady_clock::duration>(
          wait_per_writing * (std::chrono::steady_clock::now() - start), longest_wait, wait_of_large_models);
      lock.lock();
      writing.rows = 0;
      busy = false;
      failure = failed;
      changed.notify_all();
    } else if (stopping) {
      return;
    }
  }
}

void ResultsFile::Stream::wait_until_all_is_written() {
  std::unique_lock lock(guard);
  wanted_now = true;
  changed.notify_all();
  changed.wait(lock, [&] { return failure || (filling.rows == 0 && !busy); });
  wanted_now = false;
  check();
}

// -- the run's side

ResultsFile::ResultsFile(const std::string& path, const Model& model, const std::string& input_text)
    : stream_(std::make_unique<Stream>(Hdf5File::create(path), model)) {
  Hdf5File& file = stream_->file;
  file.write_attribute("/", "format", std::string("bielle results"));
  file.write_attribute("/", "version", results_version);
  file.write_attribute("/", "name", model.title);
  file.write_attribute("/", "created_by", std::string("bielle-mechanism ") + BIELLE_VERSION);
  stream_->start(input_text);
}

ResultsFile::ResultsFile(const std::string& path, const Model& model, const std::string& input_text,
                         const Checkpoint& checkpoint)
    : stream_(std::make_unique<Stream>(Hdf5File::open_to_extend(path), model)) {
  Stream& stream = *stream_;
  rewind_to(stream.file, checkpoint);
  stream.analysis = checkpoint.analysis;
  stream.group = fmt::format("/analysis_{}", checkpoint.analysis);
  stream.recorded = checkpoint.rows;
  stream.prepare_rows();
  for (const ResultsColumn& column : stream.rows.columns())
    if (const std::string dataset = stream.group + "/" + column.dataset; !stream.file.has(dataset))
      throw InputError(
          fmt::format("{}: '{}' is not in it: a run goes on with the outputs that it began with", path, dataset));
  stream.link_from_root();
  stream.file.remove("/input");
  if (stream.file.has("/parameters")) stream.file.remove("/parameters");
  stream.start(input_text);
}

void ResultsFile::Stream::start(const std::string& input_text) {
  file.write_attribute("/", "complete", std::int64_t{0});
  file.write_text("/input", input_text);
  std::string parameters;
  for (const auto& [name, value] : model.parameters) parameters += fmt::format("{} = {}\n", name, value);
  if (!parameters.empty()) file.write_text("/parameters", parameters);
  file.flush();
  writer = std::thread([this] { write_until_told_to_stop(); });
}

ResultsFile::~ResultsFile() {
  {
    const std::lock_guard lock(stream_->guard);
    stream_->stopping = true;
  }
  stream_->changed.notify_all();
  stream_->writer.join();  // which writes what waits
}

void ResultsFile::name_equations(const System& system) {
  std::string names;
  for (int i = 0; i < system.size(); ++i)
    names += fmt::format("{} [{}]\n", system.equation_name(i), system.equation_units(i));
  stream_->wait_until_all_is_written();
  if (!stream_->file.has("/equations")) stream_->file.write_text("/equations", names);
  stream_->file.flush();
}

void ResultsFile::begin_analysis(const std::string& type, std::size_t expected_rows) {
  stream_->wait_until_all_is_written();
  stream_->group = fmt::format("/analysis_{}", ++stream_->analysis);
  stream_->expected_rows = expected_rows;
  stream_->recorded = 0;
  stream_->datasets.clear();
  stream_->linked = false;
  stream_->file.make_group(stream_->group);
  stream_->file.write_attribute(stream_->group, "type", type);
}

void ResultsFile::record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                         const StepRecord& step) {
  Stream& stream = *stream_;
  if (stream.group.empty()) throw std::logic_error("a row of results outside of an analysis");
  if (stream.datasets.empty()) stream.create_datasets();
  ++stream.recorded;

  std::unique_lock lock(stream.guard);
  stream.changed.wait(lock, [&] { return stream.failure || stream.filling.rows < stream.block_rows; });
  stream.check();
  Block& block = stream.filling;
  stream.rows.fill(state, slots, environment, step, block.values.data() + block.rows * stream.rows.size());
  block.times[block.rows++] = step.time.value_or(state.time);
  if (block.rows == stream.block_rows) stream.changed.notify_all();
}

void ResultsFile::checkpoint(Archive& archive) {
  stream_->wait_until_all_is_written();
  append_checkpoint(stream_->file, stream_->model, {stream_->analysis, stream_->recorded, archive.values()});
}

void ResultsFile::exchange(Archive& archive) { stream_->rows.exchange(archive); }

void ResultsFile::end_analysis() {
  stream_->wait_until_all_is_written();
  stream_->link_from_root();  // also what was written beside the rows
}

void ResultsFile::complete() {
  stream_->wait_until_all_is_written();
  stream_->file.write_attribute("/", "complete", std::int64_t{1});
  stream_->file.close();
}

Hdf5File& ResultsFile::file() { return stream_->file; }
std::string ResultsFile::analysis_group() const { return stream_->group; }

}  // namespace bielle::mechanism
