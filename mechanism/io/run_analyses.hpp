// Runs the analyses of a mechanism file one after the other and records them.
#pragma once

#include <string>
#include <vector>

#include "mechanism/io/mechanism_file.hpp"
#include "reduce/common/progress.hpp"

namespace bielle::mechanism {

/// Runs all analyses and writes the results file.
/// @param restart  a results file of the same model to go on from, at its last checkpoint; its rows up to there become
///                 those of the new file, which may be the same one. Empty: a new run
/// @param threads  that evaluate; the numbers do not depend on them
/// @throws InputError, ComputationError; the results file then holds every row recorded so far, `complete = false`
std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress, const std::string& restart = "", int threads = 1);

}  // namespace bielle::mechanism
