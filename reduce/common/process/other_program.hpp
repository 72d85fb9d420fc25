// Other programs that this one runs.
#pragma once

#include <string>
#include <vector>

namespace bielle {

/// Runs a program without a shell; its standard output is discarded. @param command  path of the program, and its
/// arguments @param error_file  gets its standard error @returns its exit status, or 128 and the signal that ended it
/// @throws ComputationError when it cannot be started
int run_other_program(const std::vector<std::string>& command, const std::string& error_file);

/// Returns the lines of a file that are not empty; none if it cannot be read.
std::vector<std::string> lines_of_file(const std::string& path);

/// Finds a program of Bielle next to this one, or in a folder of PATH. @returns its path; empty if there is none
std::string find_sibling_program(const std::string& name);

}  // namespace bielle
