// Lines that summaries of several analyses have in common. Each ends with a new line.
#pragma once

#include <string>
#include <vector>

#include "mechanism/solvers/consistent_start.hpp"

namespace bielle::mechanism {

/// What the start had to change; nothing, where that is nothing.
std::string format_start(const StartReport& start);
/// Constraints set aside, by joint.
std::string format_redundant(const std::vector<std::string>& redundant);
/// @param records   rows
/// @param end_time  [s]
std::string format_steps(long steps, long iterations, long records, double end_time);

}  // namespace bielle::mechanism
