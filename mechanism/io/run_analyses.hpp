// Runs the analyses of a mechanism file one after the other and records them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/io/mechanism_file.hpp"
#include "reduce/common/progress.hpp"

namespace bielle::mechanism {

/// What a program that runs a file wants to have of it, besides its results file.
struct RunListener {
  ResultSink* sink = nullptr;             ///< gets what the file gets
  Notes* notes = nullptr;                 ///< gets what the user is told
  std::function<void(Session&)> on_step;  ///< if any, it is in charge of interruptions: signals stay as they are
};

/// Runs all analyses and writes the results file.
/// @param results_path  empty: no file is written
/// @param restart  a results file of the same model to go on from, at its last checkpoint; its rows up to there become
///                 those of the new file, which may be the same one. Empty: a new run
/// @param threads  that evaluate; the numbers do not depend on them
/// @throws InputError, ComputationError; the results file then holds every row recorded so far, `complete = false`
std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress, const std::string& restart = "", int threads = 1,
                                          const RunListener& listener = {});

/// What stands where results will go may be results only: never a model, a superelement or a table.
/// @throws InputError
void check_may_be_replaced(const std::string& results_path);

}  // namespace bielle::mechanism
