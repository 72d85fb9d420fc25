// Modes over a speed as result arrays for the sinks.
#pragma once

#include "mechanism/analyses/campbell.hpp"

namespace bielle::mechanism {

/// Writes the datasets `campbell/...` of the open analysis (mechanism/io/modes.md).
/// @param parameter  swept parameter; empty: the speed itself
void write_campbell(Session& session, const Campbell& found, const std::string& parameter);

/// Returns "forwards", "backwards", "plane", or "" if the mode has no sense of whirl.
const char* whirl_name(double whirl);

}  // namespace bielle::mechanism
