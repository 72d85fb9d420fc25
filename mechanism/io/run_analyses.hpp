// Runs the analyses of a mechanism file one after the other and records them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/io/mechanism_file.hpp"
#include "reduce/common/progress.hpp"

namespace bielle::mechanism {

/// Interfaces of a program that runs a file, in addition to its results file.
struct RunListener {
  ResultSink* sink = nullptr;  ///< receives the same data as the file
  Notes* notes = nullptr;      ///< receives the messages for the user
  /// If set, this function handles interruptions, and signal handlers are not changed.
  std::function<void(Session&)> on_step;
};

/// Runs all analyses and writes the results file.
/// @param results_path  empty: no file is written
/// @param restart  a results file of the same model from which the run continues, at its last checkpoint; its rows up
///                 to there become those of the new file, which may be the same one. Empty for a new run
/// @param threads  number of threads for evaluations; the results do not depend on it
/// @throws InputError, ComputationError; the results file then holds every row recorded so far, `complete = false`
std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress, const std::string& restart = "", int threads = 1,
                                          const RunListener& listener = {});

/// Checks that an existing file at the path of the results contains results, so that no model, superelement or table is
/// overwritten.
/// @throws InputError
void check_may_be_replaced(const std::string& results_path);

}  // namespace bielle::mechanism
