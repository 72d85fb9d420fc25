// The program bielle-mechanism: it reads a model file and writes the motion.
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/io/run_analyses.hpp"
#include "reduce/common/command_line.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/process/library_settings.hpp"
#include "reduce/common/process/run_program.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/dense/blas.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;

std::map<std::string, std::string> read_overrides(const std::vector<std::string>& settings) {
  std::map<std::string, std::string> overrides;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(fmt::format("--set {}: expected NAME=EXPRESSION", setting));
    overrides[setting.substr(0, equals)] = setting.substr(equals + 1);
  }
  return overrides;
}

/// @throws InputError if a continued run would replace the results of another one without being told to
std::string default_results(const std::string& model, const std::string& restart) {
  namespace fs = std::filesystem;
  const std::string results = fs::path(model).replace_extension(".h5").string();
  std::error_code none;
  if (!restart.empty() && fs::exists(results, none) && !fs::equivalent(results, restart, none))
    throw InputError(
        fmt::format("{}: exists, and the run that goes on from '{}' would replace it: say with -o where its "
                    "results go",
                    results, restart));
  return results;
}

int body(int argc, char** argv) {
  CLI::App app{"Computes the motion of a mechanism of rigid bodies, beams, superelements and joints.",
               "bielle-mechanism"};
  std::string model_path, results_path, restart_path;
  std::vector<std::string> settings;
  bool check = false;
  CommonOptions common;
  app.add_option("MODEL", model_path, "mechanism file (YAML)")->required();
  app.add_option("-o,--output", results_path, "results file (default: MODEL with the ending .h5)");
  app.add_option("--restart", restart_path, "results file to go on from, at its last checkpoint");
  app.add_option("--set", settings, "NAME=EXPRESSION: overrides a parameter of the model")->take_all()->expected(1);
  app.add_flag("--check", check, "read, assemble and describe the model without running it");
  add_common_options(app, common);
  if (!parse_command_line(app, argc, argv)) return 0;

  // Matrices of a mechanism are small, and its own threads share the elements: threads of BLAS would only slow them
  // down.
  const BlasThreads one(1);
  start_blas(common.threads);
  const MechanismFile file = read_mechanism_file(model_path, read_overrides(settings));
  Progress progress(common.quiet);
  for (const std::string& warning : file.warnings) progress.warn(warning);
  if (check) {
    fmt::print("{}", describe_model(file));
    return 0;
  }
  if (file.analyses.empty()) throw InputError(fmt::format("{}: nothing to do: the file has no `analysis`", model_path));
  if (results_path.empty()) results_path = default_results(model_path, restart_path);
  const std::vector<AnalysisSummary> summaries =
      run_analyses(file, results_path, progress, restart_path, common.threads);
  if (!common.quiet) fmt::print("{}", format_summary(file, summaries, progress.phases(), results_path));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  bielle::keep_freed_memory();
  return bielle::run_program("bielle-mechanism", body, argc, argv);
}
