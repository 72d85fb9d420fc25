// Lines that summaries of several analyses have in common. Each ends with a new line.
#pragma once

#include <string>
#include <vector>

#include "mechanism/solvers/consistent_start.hpp"

namespace bielle::mechanism {

/// What the start had to change; nothing, where that is nothing.
std::string format_start(const StartReport& start);
/// Constraints set aside, by joint, and the joints whose reactions they leave open.
std::string format_redundant(const std::vector<std::string>& redundant, const std::vector<std::string>& not_unique);
/// "the reactions of joints 'a', 'b' are not unique: the smallest are reported"; nothing where all are.
std::string describe_not_unique(const std::vector<std::string>& joints);
/// @param records   rows
/// @param end_time  [s]
std::string format_steps(long steps, long iterations, long records, double end_time);

}  // namespace bielle::mechanism
