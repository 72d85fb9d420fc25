// Runs work in a child process: if a library crashes on a damaged file, only that process ends.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace bielle {

/// Limits of a child process; 0 means no limit.
struct ChildLimits {
  int seconds = 0;           ///< processor time
  std::uint64_t memory = 0;  ///< in addition to the memory of the parent [bytes]; an allocation beyond it fails
};

/// Messages for a child process that sends no answer.
struct ChildLoss {
  std::string crashed;    ///< the process crashes, is killed or reaches its limit: "'a.msh' cannot be read: .."
  std::string ended;      ///< a library ended the process regularly before the work was done; default: `crashed`
  std::string forbidden;  ///< it tried what `forbid_other_programs` forbids; default: `crashed`
  std::string subject;    ///< key of the input that the messages are about; empty if there is none

  ChildLoss(const char* sentence) : ChildLoss(std::string(sentence)) {}
  ChildLoss(std::string sentence) : crashed(sentence), ended(sentence), forbidden(std::move(sentence)) {}
};

/// Runs `work` in a forked process and returns its text. Its changes in memory are lost; its output on standard error
/// is shown, except for reports of a crash.
///
/// @param lost  the sentence when the process ends without an answer
/// @throws InputError `lost`; otherwise the exceptions of `work` (InputError and ComputationError with their subjects,
/// std::bad_alloc)
std::string in_child_process(const ChildLoss& lost, const ChildLimits& limits,
                             const std::function<std::string()>& work);

}  // namespace bielle
