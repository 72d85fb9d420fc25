// Work in a process of its own: a library that crashes on a damaged file takes only that process with it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace bielle {

/// What a process may use; 0: without limit.
struct ChildLimits {
  int seconds = 0;           ///< of processor time
  std::uint64_t memory = 0;  ///< besides what the parent has already [bytes]; an allocation beyond it fails
};

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
/// @param lost  the sentence when the process ends without an answer
/// @throws InputError `lost`; else what `work` throws (InputError, ComputationError, std::bad_alloc)
std::string in_child_process(const ChildLoss& lost, const ChildLimits& limits,
                             const std::function<std::string()>& work);

}  // namespace bielle
