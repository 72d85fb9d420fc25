// What the program tells the user: a model without running it (`--check`), and the summary of a run.
#pragma once

#include <string>
#include <vector>

#include "mechanism/io/mechanism_file.hpp"
#include "reduce/common/progress.hpp"

namespace bielle::mechanism {

/// Nodes, components, unknowns, degrees of freedom, redundant constraints, joint frames, and how well the input
/// positions fit together. Assembles a copy of the model.
/// @throws ComputationError when the mechanism cannot be assembled
std::string describe_model(const MechanismFile& file);

/// Times, steps, iterations, the start's changes, and the energy balance of each analysis.
std::string format_summary(const MechanismFile& file, const std::vector<AnalysisSummary>& summaries,
                           const std::vector<PhaseReport>& phases, const std::string& results_path);

}  // namespace bielle::mechanism
