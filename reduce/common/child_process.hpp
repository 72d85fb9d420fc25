// Work in a process of its own: a library that crashes on a damaged file takes only that process with it.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace bielle {

/// What to say when no answer comes.
struct ChildLoss {
  std::string crashed;    ///< the process crashes, is killed or reaches its limit: "'a.msh' cannot be read: .."
  std::string ended;      ///< something in it ended it in good order before its work was done; default: `crashed`
  std::string forbidden;  ///< it tried what `forbid_other_programs` forbids; default: `crashed`

  ChildLoss(const char* sentence) : ChildLoss(std::string(sentence)) {}
  ChildLoss(std::string sentence) : crashed(sentence), ended(sentence), forbidden(std::move(sentence)) {}
};

/// Runs `work` in a forked process and returns the text that it hands back. What it changes in memory is lost; what it
/// says on standard error is shown, except for the last words of a crash.
///
/// @param lost     the sentence when the process ends without an answer
/// @param seconds  of processor time that it may use; 0: without limit
/// @throws InputError `lost`; else what `work` throws (InputError, ComputationError, std::bad_alloc)
std::string in_child_process(const ChildLoss& lost, int seconds, const std::function<std::string()>& work);

}  // namespace bielle
