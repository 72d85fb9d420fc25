// Lines that summaries of several analyses have in common. Each ends with a new line.
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/session/unique_reactions.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// What the start had to change; nothing, where that is nothing.
std::string format_start(const StartReport& start);
/// That an unknown, which nothing holds or loads, stays as drawn.
std::string format_loose(const std::string& unknown);
/// How many ways there are to move, constraints set aside or nearly so, joints whose reactions they leave open.
std::string format_mobility(const Session& session);
/// "the reactions of joints 'a', 'b' and the force of drive 'c' are not unique: the smallest are reported"; nothing
/// where all are.
std::string describe_not_unique(const NotUnique& found);
/// "joined to nothing that is held: the part of node 'lost'"; nothing where all parts are.
std::string describe_loose(const System& system);
/// "energy at the end [J]: kinetic .., .."
std::string format_energies(const Energy& energy);
/// What a user should know of the state that small motions are about, and of their axes.
/// @param what  "modes": what belongs to the equations as they are there
std::string format_setting(const LinearisedSetting& setting, const char* what);
/// @param records  rows
std::string format_steps(long steps, long iterations, long records);

}  // namespace bielle::mechanism
