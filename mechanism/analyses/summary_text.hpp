// Lines of text that the summaries of several analyses have in common. Each line ends with a line break.
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/session/unique_reactions.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Describes the changes made by the start; empty if there are none.
std::string format_start(const StartReport& start);
/// Returns the note that an unknown without support or load keeps its initial value.
std::string format_loose(const std::string& unknown);
/// Describes the degrees of freedom, redundant and nearly redundant constraints, and joints with undetermined
/// reactions.
std::string format_mobility(const Session& session);
/// Returns "the reactions of joints 'a', 'b' and the force of drive 'c' are not unique: the smallest are reported";
/// empty if all are unique.
std::string describe_not_unique(const NotUnique& found);
/// Returns "joined to nothing that is held: the part of node 'lost'"; empty if all parts are connected.
std::string describe_loose(const System& system);
/// Returns "energy at the end [J]: kinetic .., .."
std::string format_energies(const Energy& energy);
/// Describes the reference state of small motions and its axes, with warnings.
/// @param what  results of the linearised equations, for the text: "modes"
std::string format_setting(const LinearisedSetting& setting, const char* what);
/// @param records  number of rows
std::string format_steps(long steps, long iterations, long records);

}  // namespace bielle::mechanism
