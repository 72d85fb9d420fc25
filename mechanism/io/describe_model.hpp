// Output of the program: the description of a model without running it (`--check`), and the summary of a run.
#pragma once

#include <string>
#include <vector>

#include "mechanism/io/checked_model.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "reduce/common/progress.hpp"

namespace bielle::mechanism {

/// Lists counts of nodes and components, total mass and its centre, unknowns, degrees of freedom, redundant
/// constraints, the errors of the input positions, unused nodes, directions without mass, and every entry as its
/// components describe it. It takes time in proportion to the model, apart from the analysis of constraints.
/// @throws ComputationError if the mechanism cannot be assembled
std::string describe_model(const CheckedModel& checked);
std::string describe_model(const MechanismFile& file);

/// Lists times, steps, iterations, changes that the start made, and the energy balance of each analysis.
std::string format_summary(const MechanismFile& file, const std::vector<AnalysisSummary>& summaries,
                           const std::vector<PhaseReport>& phases, const std::string& results_path);

}  // namespace bielle::mechanism
