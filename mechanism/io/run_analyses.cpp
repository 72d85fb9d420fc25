#include "mechanism/io/run_analyses.hpp"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "mechanism/io/interrupt_guard.hpp"
#include "mechanism/io/results_file.hpp"
#include "mechanism/io/step_log.hpp"
#include "reduce/common/file_checks.hpp"
#include "reduce/common/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

/// What a session says goes to the user.
class ShownNotes : public Notes {
 public:
  explicit ShownNotes(Progress& progress) : progress_(progress) {}
  void progress(double done, const std::string& where) override { progress_.update(done, where); }
  void note(const std::string& sentence) override { progress_.note(sentence); }

 private:
  Progress& progress_;
};

/// A run that was killed at its very beginning leaves the head of an HDF5 file.
constexpr std::uintmax_t bare_head = 96;

bool holds_results(const std::string& path) {
  try {
    return Hdf5File::open(path).read_text_attribute("/", "format") == "bielle results";
  } catch (const InputError&) {
    return false;  // no HDF5 file at all, or none of ours
  }
}

/// What stands where the results will go may be results only: never a model, a superelement or a table.
void check_may_be_replaced(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (!fs::exists(path, none) || fs::file_size(path, none) == 0) return;
  if (fs::file_size(path, none) <= bare_head && Hdf5File::begins_like_one(path)) return;
  if (holds_results(path)) return;
  throw InputError(fmt::format(
      "{}: exists and is no results file; the results would replace it: choose another name with -o", path));
}

/// What a run that fails leaves where there was nothing is removed if it holds no results: a full disk cuts files off.
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

/// The checkpoint to go on from, which is then in the results file. @throws InputError when there is none for this
/// model
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
    throw ComputationError(
        fmt::format("{}: cannot be copied to '{}': {}", restart, results_path, none.message()));
  return checkpoint;
}

std::unique_ptr<ResultsFile> open_results(const MechanismFile& file, const std::string& path,
                                          const std::optional<Checkpoint>& checkpoint) {
  return checkpoint ? std::make_unique<ResultsFile>(path, file.model, file.text, *checkpoint, file.output.layout)
                    : std::make_unique<ResultsFile>(path, file.model, file.text, file.output.layout);
}

}  // namespace

std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress, const std::string& restart, int threads) {
  check_output_file(results_path);
  check_may_be_replaced(results_path);
  const Remains remains(results_path);
  std::optional<Checkpoint> checkpoint;
  if (!restart.empty()) checkpoint = take_checkpoint(file, restart, results_path);
  std::optional<Session> session;
  try {
    session.emplace(file.model, threads);
  } catch (const ComputationError&) {
    open_results(file, results_path, checkpoint);  // whatever stood there, it says that this run has failed
    throw;
  }
  const std::unique_ptr<ResultsFile> results = open_results(file, results_path, checkpoint);
  results->name_equations(session->system());
  session->add_sink(*results);
  session->set_recording(file.output.recording);
  ShownNotes notes(progress);
  session->set_notes(&notes);
  std::optional<StepLog> log;
  if (file.output.log) {
    log.emplace(results_path, session->system(), checkpoint.has_value());
    session->on_attempt([&](const Attempt& attempt) { log->write(attempt); });
  }
  const InterruptGuard guard;
  std::string advice;  // how to go on after an interruption
  session->on_step([&](Session& at) { guard.check(at.time(), advice); });

  std::vector<AnalysisSummary> summaries;
  for (std::size_t k = 0; k < file.analyses.size(); ++k) {
    const Analysis& analysis = *file.analyses[k];
    const int number = static_cast<int>(k) + 1;
    if (checkpoint && number < checkpoint->analysis) continue;
    progress.start(analysis.type());
    advice = !analysis.can_go_on() ? ""
                                   : fmt::format("; `bielle-mechanism {} --restart {}` goes on from there",
                                                 file.path.empty() ? "MODEL.yaml" : file.path, results_path);
    summaries.push_back(checkpoint && number == checkpoint->analysis
                            ? analysis.go_on(*session, checkpoint->values, *results)
                            : analysis.run(*session));
  }
  progress.finish();
  results->complete();
  return summaries;
}

}  // namespace bielle::mechanism
