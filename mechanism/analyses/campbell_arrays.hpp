// Modes over a speed as results: arrays for the sinks.
#pragma once

#include "mechanism/analyses/campbell.hpp"

namespace bielle::mechanism {

/// The datasets `campbell/...` of the open analysis (mechanism/io/README.md).
/// @param parameter  that was swept; empty: the speed itself
void write_campbell(Session& session, const Campbell& found, const std::string& parameter);

/// "forwards", "backwards", "plane", or "" where a mode has no sense.
const char* whirl_name(double whirl);

}  // namespace bielle::mechanism
