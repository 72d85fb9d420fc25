#include "mechanism/io/run_analyses.hpp"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "mechanism/io/interrupt_guard.hpp"
#include "mechanism/results/results_file.hpp"
#include "mechanism/results/step_log.hpp"
#include "reduce/common/files/file_checks.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/files/hdf5_soundness.hpp"

namespace bielle::mechanism {
namespace {

/// Shows the messages of a session to the user.
class ShownNotes : public Notes {
 public:
  ShownNotes(Progress& progress, Notes* others) : progress_(progress), others_(others) {}
  void progress(double done, const std::function<std::string()>& at) override {
    if (progress_.due()) progress_.update(done, at());
  }
  void note(const std::string& sentence) override {
    progress_.note(sentence);
    if (others_) others_->note(sentence);
  }

 private:
  Progress& progress_;
  Notes* others_;
};

/// Size of the header of an HDF5 file [bytes], which is all that a run leaves if it is killed at its very beginning.
constexpr std::uintmax_t bare_head = 96;

bool holds_results(const std::string& path) { return root_text_attribute(path, "format") == "bielle results"; }

/// Removes a new file without results if the run fails. (A full disk, for example, truncates files.)
class Remains {
 public:
  explicit Remains(std::string path) : path_(std::move(path)), thrown_(std::uncaught_exceptions()) {
    std::error_code none;
    new_ = !std::filesystem::exists(path_, none) || std::filesystem::file_size(path_, none) == 0;
  }
  ~Remains() {
    std::error_code none;
    if (new_ && std::uncaught_exceptions() > thrown_ && !holds_results(path_)) std::filesystem::remove(path_, none);
  }
  Remains(const Remains&) = delete;
  Remains& operator=(const Remains&) = delete;

 private:
  std::string path_;
  int thrown_;
  bool new_ = false;
};

/// Returns the checkpoint from which to continue, after copying it to the results file. @throws InputError if there is
/// none for this model
Checkpoint take_checkpoint(const MechanismFile& file, const std::string& restart, const std::string& results_path) {
  namespace fs = std::filesystem;
  Checkpoint checkpoint = read_checkpoint(restart, file.model);
  if (checkpoint.analysis > static_cast<int>(file.analyses.size()))
    throw InputError(fmt::format("{}: its last checkpoint is of analysis {}, and the model has {}", restart,
                                 checkpoint.analysis, file.analyses.size()));
  const Analysis& analysis = *file.analyses[static_cast<std::size_t>(checkpoint.analysis) - 1];
  if (!analysis.can_go_on())
    throw InputError(
        fmt::format("{}: its last checkpoint is of analysis {}, which is '{}' in the model and not a dynamic one",
                    restart, checkpoint.analysis, analysis.type()));
  std::error_code none;
  if (fs::equivalent(restart, results_path, none)) return checkpoint;
  fs::copy_file(restart, results_path, fs::copy_options::overwrite_existing, none);
  if (none)
    throw ComputationError(fmt::format("{}: cannot be copied to '{}': {}", restart, results_path, none.message()));
  return checkpoint;
}

std::unique_ptr<ResultsFile> open_results(const MechanismFile& file, const std::string& path,
                                          const std::optional<Checkpoint>& checkpoint) {
  if (path.empty()) return nullptr;
  return checkpoint ? std::make_unique<ResultsFile>(path, file.model, file.text, *checkpoint, file.output.layout)
                    : std::make_unique<ResultsFile>(path, file.model, file.text, file.output.layout);
}

}  // namespace

void check_may_be_replaced(const std::string& results_path) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (!fs::exists(results_path, none) || fs::file_size(results_path, none) == 0) return;
  if (fs::file_size(results_path, none) <= bare_head && Hdf5File::begins_like_one(results_path)) return;
  if (holds_results(results_path)) return;
  throw InputError(fmt::format(
      "{}: exists and is no results file; the results would replace it: choose another name with -o", results_path));
}

std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress, const std::string& restart, int threads,
                                          const RunListener& listener) {
  std::optional<Remains> remains;
  if (!results_path.empty()) {
    check_output_file(results_path);
    check_may_be_replaced(results_path);
    remains.emplace(results_path);
  } else if (!restart.empty()) {
    throw InputError("a run that goes on from a results file needs one for its own results");
  }
  std::optional<Checkpoint> checkpoint;
  if (!restart.empty()) checkpoint = take_checkpoint(file, restart, results_path);
  std::optional<Session> session;
  try {
    session.emplace(file.model, threads);
  } catch (const ComputationError&) {
    open_results(file, results_path, checkpoint);  // the file records that this run has failed
    throw;
  }
  const std::unique_ptr<ResultsFile> results = open_results(file, results_path, checkpoint);
  if (results) {
    results->name_equations(session->system());
    session->add_sink(*results);
  }
  if (listener.sink) session->add_sink(*listener.sink);
  session->set_recording(file.output.recording);
  ShownNotes notes(progress, listener.notes);
  session->set_notes(&notes);
  std::optional<StepLog> log;
  if (file.output.log && !results) notes.note("`log`: there is no results file to write the log of steps next to");
  if (file.output.log && results) {
    log.emplace(results_path, session->system(), restart);
    results->keep_with(*log);
    session->on_attempt([&](const Attempt& attempt) { log->write(attempt); });
  }
  std::optional<InterruptGuard> guard;
  const Analysis* present = nullptr;
  std::string advice;  // instruction how to continue after an interruption
  if (listener.on_step) {
    session->on_step(listener.on_step);
  } else {
    guard.emplace();
    session->on_step([&](Session& at) {
      if (guard->asked()) guard->end_run("at " + present->place(at), advice);
    });
  }

  std::vector<AnalysisSummary> summaries;
  for (std::size_t k = 0; k < file.analyses.size(); ++k) {
    const Analysis& analysis = *file.analyses[k];
    const int number = static_cast<int>(k) + 1;
    if (checkpoint && number < checkpoint->analysis) continue;
    // Analyses without callbacks (eigen, frequency_response) run to their end, unless they are interrupted again.
    if (guard && guard->asked()) guard->end_run(fmt::format("before analysis {}", number));
    present = &analysis;
    progress.start(analysis.type());
    advice = !analysis.can_go_on() ? ""
                                   : fmt::format("; `bielle-mechanism {} --restart {}` goes on from there",
                                                 file.path.empty() ? "MODEL.yaml" : file.path, results_path);
    summaries.push_back(checkpoint && number == checkpoint->analysis
                            ? analysis.go_on(*session, checkpoint->values, *results)
                            : analysis.run(*session));
    if (results) summaries.back().text += results->largest_values();
  }
  progress.finish();
  if (results) results->complete();
  return summaries;
}

}  // namespace bielle::mechanism
