// Work in a process of its own: a library that crashes on a damaged file takes only that process with it.
#pragma once

#include <functional>
#include <string>

namespace bielle {

/// Runs `work` in a forked process and returns the text that it hands back. What it changes in memory is lost; what it
/// says on standard error is shown, except for the last words of a crash.
///
/// @param lost     the sentence when the process crashes, is killed or reaches its limit: "'a.msh' cannot be read: .."
/// @param seconds  of processor time that it may use; 0: without limit
/// @throws InputError `lost`; else what `work` throws (InputError, ComputationError, std::bad_alloc)
std::string in_child_process(const std::string& lost, int seconds, const std::function<std::string()>& work);

}  // namespace bielle
