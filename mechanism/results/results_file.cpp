#include "mechanism/results/results_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "mechanism/model/activity.hpp"
#include "mechanism/results/model_drawing.hpp"
#include "mechanism/results/results_datasets.hpp"
#include "mechanism/results/results_stream.hpp"
#include "mechanism/results/step_log.hpp"
#include "mechanism/system/system.hpp"
#include "reduce/common/build.hpp"

namespace bielle::mechanism {

namespace {

/// The version depends on the layout, because old readers of names only support the first one.
std::int64_t version_of(ResultsLayout layout) { return layout == ResultsLayout::named ? 1 : 2; }

/// Returns the layout of a file that is continued.
ResultsLayout layout_of(const Hdf5File& file, std::optional<ResultsLayout> wanted) {
  ResultsLayout found = ResultsLayout::named;  // default for files without this attribute
  if (file.has_attribute("/", "layout") &&
      file.read_text_attribute("/", "layout") == layout_name(ResultsLayout::stacked))
    found = ResultsLayout::stacked;
  if (wanted && *wanted != found)
    throw InputError(
        fmt::format("{}: has the layout '{}', and the model asks for '{}': a run goes on with the layout "
                    "that it began with",
                    file.path(), layout_name(found), layout_name(*wanted)));
  return found;
}

std::unique_ptr<ResultsStream> extend(const std::string& path, const Model& model,
                                      std::optional<ResultsLayout> wanted) {
  Hdf5File file = Hdf5File::open_to_extend(path);
  const ResultsLayout layout = layout_of(file, wanted);
  return std::make_unique<ResultsStream>(std::move(file), model, layout);
}

void begin_run(ResultsStream& stream, const std::string& input_text) {
  Hdf5File& file = stream.file();
  file.write_attribute("/", "complete", std::int64_t{0});
  file.write_text("/input", input_text);
  std::string parameters;
  for (const auto& [name, value] : stream.model().parameters) parameters += fmt::format("{} = {}\n", name, value);
  if (!parameters.empty()) file.write_text("/parameters", parameters);
  write_drawing(file, stream.model());
  file.flush();
  stream.start();
}

/// Lists the entries that are released when an analysis begins, if any can be.
void write_released(Hdf5File& file, const std::string& group, const Model& model, const State& state,
                    const std::vector<Slots>& slots) {
  const std::vector<Member>& members = model.members();
  bool any = false;
  std::string released;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const auto* activity = dynamic_cast<const Activity*>(members[k].component.get());
    if (activity == nullptr) continue;
    any = true;
    if (state.memory[slots[k].memory_begin] == 0) released += results_path(activity->entry()) + "\n";
  }
  if (any) file.write_attribute(group, "released", released);
}

std::string group_of(int analysis) { return fmt::format("/analysis_{}", analysis); }

}  // namespace

ResultsFile::ResultsFile(const std::string& path, const Model& model, const std::string& input_text,
                         std::optional<ResultsLayout> layout)
    : stream_(std::make_unique<ResultsStream>(Hdf5File::create(path), model, layout)) {
  Hdf5File& file = stream_->file();
  file.write_attribute("/", "format", std::string("bielle results"));
  file.write_attribute("/", "version", version_of(stream_->layout()));
  file.write_attribute("/", "layout", std::string(layout_name(stream_->layout())));
  file.write_attribute("/", "name", model.title);
  file.write_attribute("/", "created_by", created_by("bielle-mechanism"));
  begin_run(*stream_, input_text);
}

ResultsFile::ResultsFile(const std::string& path, const Model& model, const std::string& input_text,
                         const Checkpoint& checkpoint, std::optional<ResultsLayout> layout)
    : stream_(extend(path, model, layout)), analysis_(checkpoint.analysis) {
  Hdf5File& file = stream_->file();
  stream_->check_datasets(group_of(analysis_));  // before anything is removed
  if (checkpoint.rows_sum) stream_->check_rows(checkpoint.rows, *checkpoint.rows_sum);
  rewind_to(file, checkpoint);
  stream_->resume(group_of(analysis_), checkpoint.rows);
  stream_->largest().begin("the rows recorded since the restart", "t", " s");
  file.remove("/input");
  if (file.has("/parameters")) file.remove("/parameters");
  begin_run(*stream_, input_text);
}

ResultsFile::~ResultsFile() = default;

void ResultsFile::name_equations(const System& system) {
  std::string names;
  for (int i = 0; i < system.size(); ++i)
    fmt::format_to(std::back_inserter(names), "{} [{}]\n", system.equation_name(i), system.equation_units(i));
  Hdf5File& written = file();
  if (!written.has("/equations")) written.write_text("/equations", names);
  std::string crossings;
  for (const MemberEventFunction& each : system.event_functions()) crossings += each.name + "\n";
  if (!crossings.empty() && !written.has("/crossings")) written.write_text("/crossings", crossings);
  written.flush();
}

void ResultsFile::begin_analysis(const std::string& type, std::size_t expected_rows) {
  stream_->wait_until_all_is_written();
  stream_->begin(group_of(++analysis_), expected_rows);
  const bool loads = type == "static";
  stream_->largest().begin("the recorded rows", loads ? "load factor" : "t", loads ? "" : " s");
  events_ = 0;
  stream_->file().make_group(stream_->group());
  stream_->file().write_attribute(stream_->group(), "type", type);
}

void ResultsFile::record(const State& state, const std::vector<Slots>& slots, const Environment& environment,
                         const StepRecord& step) {
  if (stream_->recorded() == 0) write_released(file(), analysis_group(), stream_->model(), state, slots);
  stream_->record(state, slots, environment, step);
}

void ResultsFile::write(const ResultArray& array) {
  const std::string units = array.units.empty() ? "-" : array.units;
  file().write(analysis_group() + "/" + array.dataset, array.values, array.shape, units, array.description);
}

void ResultsFile::write(const ResultNames& names) {
  file().write_names(analysis_group() + "/" + names.dataset, names.names);
}

void ResultsFile::write(const EntryNumbers& numbers) {
  write_numbers(file(), analysis_group(), stream_->rows().kinds(), stream_->layout(), numbers);
}

void ResultsFile::note(const Event& event) {
  Hdf5File& written = file();
  const std::string group = analysis_group() + "/events";
  constexpr std::size_t together = 64;
  if (!written.has(group)) {
    written.make_group(group);
    written.create_rows(group + "/crossing", {}, "-", "line of /crossings, from 0", together);
    written.create_rows(group + "/time", {}, "s", "at which crossings were met", together);
    written.link(group, "/events");  // linked now, because a run that fails does not reach the end
  }
  const double crossing = event.event_function;
  written.append_rows(group + "/crossing", {&crossing, 1});
  written.append_rows(group + "/time", {&event.time, 1});
  written.flush();
  ++events_;
}

std::string ResultsFile::largest_values() {
  stream_->wait_until_all_is_written();
  return stream_->largest().summary();
}

void ResultsFile::checkpoint(Archive& archive) {
  Hdf5File& written = file();
  append_checkpoint(written, stream_->model(),
                    {analysis_, stream_->recorded(), archive.values(), stream_->sum_of_rows()});
}

void ResultsFile::exchange(Archive& archive) {
  stream_->wait_until_all_is_written();
  stream_->rows().exchange(archive);
  archive.within(events_, 0, 1e15);
  long lines = log_ && !archive.restoring() ? log_->lines() : 0;
  archive.within(lines, 0, 1e15);
  if (!archive.restoring()) return;
  if (log_) log_->go_on_after(lines);
  // Events after the checkpoint will be written again.
  Hdf5File& file = stream_->file();
  for (const char* dataset : {"/events/crossing", "/events/time"})
    if (const std::string name = analysis_group() + dataset; file.has(name))
      file.truncate_rows(name, static_cast<std::size_t>(events_));
}

void ResultsFile::end_analysis() {
  stream_->wait_until_all_is_written();
  stream_->link_from_root();  // links also the data written in addition to rows
}

void ResultsFile::complete() {
  file().write_attribute("/", "complete", std::int64_t{1});
  file().close();
}

Hdf5File& ResultsFile::file() {
  stream_->wait_until_all_is_written();
  return stream_->file();
}

std::string ResultsFile::analysis_group() const { return stream_->group(); }

}  // namespace bielle::mechanism
