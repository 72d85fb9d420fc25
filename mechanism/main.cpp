// The program bielle-mechanism: it reads a model file and writes the motion.
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "mechanism/io/checked_model.hpp"
#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/io/mechanism_keys.hpp"
#include "mechanism/io/run_analyses.hpp"
#include "mechanism/language/language_keys.hpp"
#include "reduce/common/command_line.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/key_schema.hpp"
#include "reduce/common/input/key_words.hpp"
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

/// Returns the path of the results file. @throws InputError if a continued run would replace the results of another
/// one, unless the user asks for it
std::string default_results(const std::string& model, const std::string& chosen_case, const std::string& restart) {
  namespace fs = std::filesystem;
  const std::string ending = chosen_case.empty() ? ".h5" : fmt::format("_{}.h5", chosen_case);
  const std::string results = fs::path(model).replace_extension().string() + ending;
  std::error_code none;
  if (!restart.empty() && fs::exists(results, none) && !fs::equivalent(results, restart, none))
    throw InputError(
        fmt::format("{}: exists, and the run that goes on from '{}' would replace it: say with -o where its "
                    "results go",
                    results, restart));
  return results;
}

/// Options of one call of the program.
struct Options {
  std::string model, results, restart, chosen_case, keys_of;
  std::vector<std::string> settings;
  bool check = false, expand = false, all_cases = false, schema = false;
  CommonOptions common;
};

/// Describes the model, and writes its position if a results file is named.
void check(const MechanismFile& file, const Options& options) {
  const CheckedModel checked(file);
  if (!options.results.empty()) write_checked_model(checked, options.results);
  fmt::print("{}", describe_model(checked));
  if (!options.results.empty()) fmt::print("results: {}\n", options.results);
}

/// Runs the model, or one of its cases.
void run(const Options& options, const std::string& chosen_case) {
  const MechanismFile file = read_mechanism_file(options.model, read_overrides(options.settings), chosen_case);
  Progress progress(options.common.quiet);
  for (const std::string& warning : file.warnings) progress.warn(warning);
  if (options.expand) fmt::print("{}", file.text);
  if (options.check || options.expand) {
    if (!options.expand) check(file, options);
    return;
  }
  if (file.analyses.empty())
    throw InputError(fmt::format("{}: nothing to do: the file has no `analysis`{}", options.model,
                                 read_case_names(options.model).empty() ? "" : "; --case NAME runs one of its cases"));
  const std::string results =
      options.results.empty() ? default_results(options.model, chosen_case, options.restart) : options.results;
  const std::vector<AnalysisSummary> summaries =
      run_analyses(file, results, progress, options.restart, options.common.threads);
  if (!options.common.quiet) fmt::print("{}", format_summary(file, summaries, progress.phases(), results));
}

/// Runs all cases, each with results of its own.
void run_all_cases(const Options& options) {
  const std::vector<std::string> names = read_case_names(options.model);
  if (names.empty()) throw InputError(fmt::format("--all-cases: {} has no `cases`", options.model));
  if (!options.results.empty() || !options.restart.empty())
    throw InputError("--all-cases: each case has a results file of its own, MODEL_CASE.h5; leave -o and --restart out");
  for (const std::string& name : names) {
    if (!options.common.quiet) fmt::print("case {}\n", name);
    run(options, name);
  }
}

int body(int argc, char** argv) {
  CLI::App app{"Computes the motion of a mechanism of rigid bodies, beams, superelements and joints.",
               "bielle-mechanism"};
  Options options;
  app.add_option("MODEL", options.model, "mechanism file (YAML)");
  app.add_option("-o,--output", options.results, "results file (default: MODEL with the ending .h5)");
  app.add_option("--restart", options.restart, "results file to go on from, at its last checkpoint");
  app.add_option("--set", options.settings, "NAME=EXPRESSION: overrides a parameter of the model")
      ->take_all()
      ->expected(1);
  CLI::Option* one_case = app.add_option("--case", options.chosen_case, "runs one of the file's `cases`");
  app.add_flag("--all-cases", options.all_cases, "runs all of the file's `cases`")->excludes(one_case);
  app.add_flag("--check", options.check,
               "read, assemble and describe the model without running it; with -o write its position");
  app.add_flag("--expand", options.expand,
               "print the model with every included, repeated and placed entry written out");
  app.add_option("--keys", options.keys_of, "explain the keys of a type or section, or of `all`")->expected(1);
  app.add_flag("--schema", options.schema, "print the JSON schema of mechanism files, for editors");
  add_common_options(app, options.common);
  app.footer(
      "\nThe manual is in mechanism/manual of the sources, or of share/doc/bielle if installed: README.md leads to "
      "the\n"
      "pages. --keys TYPE and --explain MESSAGE show parts of it.");
  if (!parse_command_line(app, argc, argv)) return 0;
  if (!options.keys_of.empty()) {
    fmt::print("{}", keys_of_named(mechanism_file_keys(), options.keys_of));
    return 0;
  }
  if (options.schema) {
    fmt::print("{}", write_key_schema(mechanism_file_keys(), "mechanism file of bielle-mechanism",
                                      {entry_keys(), {{"node", body_point_keys}}}));
    return 0;
  }
  if (options.model.empty()) throw InputError("MODEL is required; --help shows the options");

  // Matrices of a mechanism are small, and its own threads share the elements: threads of BLAS would only slow them
  // down.
  const BlasThreads one(1);
  start_blas(options.common.threads);
  if (options.all_cases)
    run_all_cases(options);
  else
    run(options, options.chosen_case);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  bielle::keep_freed_memory();
  return bielle::run_program("bielle-mechanism", body, argc, argv);
}
