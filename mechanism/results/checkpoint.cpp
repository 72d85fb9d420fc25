#include "mechanism/results/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <sstream>

#include <fmt/format.h>

#include "mechanism/model/model.hpp"
#include "mechanism/results/model_difference.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/files/checksum.hpp"
#include "reduce/common/files/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

const std::string root = "/checkpoints";

/// Checksums have 52 bits.
constexpr double most_of_sums = 4503599627370495;

std::string analysis_name(int analysis) { return fmt::format("/analysis_{}", analysis); }

/// Calls `act` with every dataset below a group.
void for_each_dataset(const Hdf5File& file, const std::string& group,
                      const std::function<void(const std::string&)>& act) {
  for (const std::string& name : file.names_in(group)) {
    const std::string object = group + "/" + name;
    if (file.is_group(object))
      for_each_dataset(file, object, act);
    else
      act(object);
  }
}

/// Returns the first difference between two fingerprints: "rigid_body 'rod'".
std::string difference(const std::string& one, const std::string& other) {
  std::istringstream lines(one), other_lines(other);
  std::string line, other_line;
  while (true) {
    const bool more = static_cast<bool>(std::getline(lines, line)),
               other_more = static_cast<bool>(std::getline(other_lines, other_line));
    if (more && other_more && line == other_line) continue;
    const std::string& differs = more ? line : other_line;
    const std::size_t quote = differs.rfind('\'');
    return quote == std::string::npos ? differs.substr(0, differs.find(' ')) : differs.substr(0, quote + 1);
  }
}

/// Returns the component with different forces, otherwise the entry with different input.
std::string named_difference(const std::string& wanted, const std::string& found, const std::string& entry) {
  const std::string component = found == wanted ? entry : difference(wanted, found);
  return component.find('\'') == std::string::npos && !entry.empty() ? entry : component;
}

/// @throws InputError if a checkpoint with this fingerprint and source cannot be continued with the model
void check_same_model(const std::string& file, const std::string& found, const std::string& source,
                      const Model& model) {
  const std::string wanted = fingerprint(model);
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  if (first_line(found) != first_line(wanted))
    throw InputError(fmt::format(
        "{}: its checkpoints were written by another version of bielle-mechanism ({} in place of {}), which this one "
        "cannot go on from: run the model anew, or go on with the version that wrote them (`created_by` in the file)",
        file, first_line(found).rfind("checkpoint format", 0) == 0 ? first_line(found) : "no format",
        first_line(wanted)));
  const ModelDifference differs = difference_from(source, model);
  if (found == wanted && differs.values.empty()) return;
  throw InputError(
      fmt::format("{}: is of another model: {} differs{}. All but `analysis`, `output` and `mechanism` has to be the "
                  "same to go on: go on with the model that the file keeps under /input, or run the new one from its "
                  "start",
                  file, named_difference(wanted, found, differs.entry),
                  differs.values.empty() ? ", or stands in another place" : ": " + differs.values));
}

[[noreturn]] void fail_damaged(const Hdf5File& file, const std::string& what) {
  throw InputError(
      fmt::format("{}: {}: the checkpoints are damaged, and no run can go on from them", file.path(), what));
}

/// Returns the number of rows of its analysis that belong to a checkpoint.
std::size_t recorded_rows(const Hdf5File& file, int analysis, double last) {
  const std::string time = analysis_name(analysis) + "/time";
  const Shape shape = file.has(time) ? file.shape(time) : Shape{0};
  if (shape.size() != 1) fail_damaged(file, time + " is no list of numbers");
  const auto there = static_cast<double>(shape[0]);
  if (!(last >= 1 && last <= there && last == std::floor(last)))
    fail_damaged(file, fmt::format("a checkpoint counts {} rows of {}, of which there are {}", last, time, there));
  return static_cast<std::size_t>(last);
}

/// @param n  number of the row, from 1
std::vector<double> nth_state(const Hdf5File& file, const std::string& group, std::size_t n) {
  const Shape shape = file.shape(group + "/state");
  if (shape.size() != 2 || shape[0] < n)
    fail_damaged(file, fmt::format("{}/state has not one row for each of {}", group, counted(n, "checkpoint")));
  const std::vector<double> states = file.read(group + "/state");
  const auto begin = states.begin() + static_cast<std::ptrdiff_t>((n - 1) * shape[1]);
  return {begin, begin + static_cast<std::ptrdiff_t>(shape[1])};
}

std::int64_t sum_of(const Checkpoint& checkpoint) {
  Checksum sum;
  sum.add(static_cast<double>(checkpoint.rows));
  sum.add(checkpoint.values);
  return sum.value();
}

/// Throws if the numbers of a checkpoint do not have its checksums; older files have none.
void check_sum(const Hdf5File& file, const std::string& group, std::size_t count, const Checkpoint& checkpoint) {
  if (!file.has(group + "/checksum")) return;
  const std::vector<double> sums = file.read(group + "/checksum");
  if (sums.size() < count || sums[count - 1] != static_cast<double>(sum_of(checkpoint)))
    fail_damaged(file, group + "/state does not hold the numbers that were written");
}

/// Appends the anchor of an interrupted run, which is the checkpoint at which the run rebuilt its tangents
/// (Motion::save_where_interrupted).
void append_anchor(const Hdf5File& file, const std::string& group, const std::vector<double>& rows,
                   Checkpoint& checkpoint) {
  const std::vector<double>& values = checkpoint.values;
  if (values.size() < 2 || !(values[0] > 0)) return;
  const double back = values[1];
  if (!(back >= 1 && back == std::floor(back) && back < static_cast<double>(rows.size())))
    fail_damaged(file, group + "/state tells of a checkpoint that is not there");
  const std::size_t n = rows.size() - static_cast<std::size_t>(back);
  Checkpoint anchor{checkpoint.analysis, recorded_rows(file, checkpoint.analysis, rows[n - 1]),
                    nth_state(file, group, n)};
  check_sum(file, group, n, anchor);
  checkpoint.values.insert(checkpoint.values.end(), anchor.values.begin(), anchor.values.end());
}

}  // namespace

Checkpoint read_checkpoint(const std::string& results_path, const Model& model) {
  const Hdf5File file = Hdf5File::open(results_path);
  Checkpoint checkpoint;
  if (file.has(root))
    for (int k = 1; file.has(analysis_name(k)); ++k)
      if (const std::string rows = root + analysis_name(k) + "/rows"; file.has(rows)) {
        const Shape shape = file.shape(rows);
        if (shape.size() != 1) fail_damaged(file, rows + " is no list of numbers");
        if (shape[0] > 0) checkpoint.analysis = k;
      }
  if (checkpoint.analysis == 0)
    throw InputError(
        fmt::format("{}: holds no checkpoint to go on from; a run writes them with `output: {{checkpoint: "
                    "STEPS}}`, when it is interrupted and at the end of each dynamic analysis",
                    results_path));
  check_same_model(results_path, file.read_text(root + "/model"),
                   file.has(root + "/source") ? file.read_text(root + "/source") : "", model);
  const std::string group = root + analysis_name(checkpoint.analysis);
  const std::vector<double> rows = file.read(group + "/rows");
  checkpoint.rows = recorded_rows(file, checkpoint.analysis, rows.back());
  checkpoint.values = nth_state(file, group, rows.size());
  check_sum(file, group, rows.size(), checkpoint);
  append_anchor(file, group, rows, checkpoint);
  if (file.has(group + "/rows_checksum")) {
    const std::vector<double> sums = file.read(group + "/rows_checksum");
    if (sums.size() < rows.size()) fail_damaged(file, group + "/rows_checksum is too short");
    const double sum = sums[rows.size() - 1];
    if (!(sum >= 0 && sum <= most_of_sums && sum == std::floor(sum)))
      fail_damaged(file, group + "/rows_checksum is none");
    checkpoint.rows_sum = static_cast<std::int64_t>(sum);
  }
  return checkpoint;
}

void append_checkpoint(Hdf5File& file, const Model& model, const Checkpoint& checkpoint) {
  const std::string group = root + analysis_name(checkpoint.analysis), state = group + "/state", rows = group + "/rows",
                    sums = group + "/checksum", rows_sums = group + "/rows_checksum";
  if (!file.has(root + "/model")) {
    file.write_text(root + "/source", source_lines(model));
    file.write_text(root + "/model", fingerprint(model));
  }
  if (!file.has(rows)) {
    constexpr std::size_t together = 16;
    file.create_rows(state, {checkpoint.values.size()}, "-", "all that a run goes on from", together);
    file.create_rows(sums, {}, "-", "of each state and its number of rows", 1024);
    file.create_rows(rows_sums, {}, "-", "of all rows of results that each checkpoint counts", 1024);
    file.create_rows(rows, {}, "-", "of the analysis's results that belong to each checkpoint", 1024);
  }
  file.append_rows(state, checkpoint.values);
  const auto sum = static_cast<double>(sum_of(checkpoint));
  if (file.has(sums)) file.append_rows(sums, {&sum, 1});
  const auto rows_sum = static_cast<double>(checkpoint.rows_sum.value_or(0));
  if (file.has(rows_sums)) file.append_rows(rows_sums, {&rows_sum, 1});
  file.flush();
  const auto count = static_cast<double>(checkpoint.rows);
  file.append_rows(rows, {&count, 1});
  file.flush();
}

void rewind_to(Hdf5File& file, const Checkpoint& checkpoint) {
  for (int k = checkpoint.analysis + 1; file.has(analysis_name(k)); ++k) file.remove(analysis_name(k));
  const std::string group = analysis_name(checkpoint.analysis);
  // The times are truncated first, because rows beyond them do not count.
  file.truncate_rows(group + "/time", checkpoint.rows);
  file.flush();
  // Events are not rows over time; their number is stored in the checkpoint (ResultsFile::exchange).
  // Results that an analysis writes at its end (`reaction_unique`) will be written again.
  std::vector<std::string> of_the_end;
  for_each_dataset(file, group, [&](const std::string& dataset) {
    if (file.grows(dataset)) {
      if (dataset.rfind(group + "/events/", 0) != 0) file.truncate_rows(dataset, checkpoint.rows);
    } else if (!file.is_text(dataset)) {  // texts stay: they are names and attributes of recorded entries
      of_the_end.push_back(dataset);
    }
  });
  for (const std::string& dataset : of_the_end) file.remove(dataset);
  const std::string checkpoints = root + group;
  for (const char* dataset : {"/state", "/checksum", "/rows_checksum"})
    if (file.has(checkpoints + dataset))
      file.truncate_rows(checkpoints + dataset, file.shape(checkpoints + "/rows")[0]);
  file.flush();
}

}  // namespace bielle::mechanism
