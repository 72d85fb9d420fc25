// Guard that lets an interrupted run finish its current step; a second interrupt ends the run at once.
#pragma once

#include <string>

namespace bielle::mechanism {

/// During the lifetime of this object, the run stops at the end of the current step after an interrupt (Ctrl-C), a
/// termination request or the end of the terminal. A second one, at least half a second later, ends the program at
/// once. Without it, an analysis without steps (eigen, frequency_response) runs to its end.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  bool asked() const;  ///< whether the run was asked to end
  /// @param place   place of the run, for the message: "at t = 0.3 s", "before analysis 2"
  /// @param advice  instruction for continuing, for the message
  /// @throws Interrupted
  [[noreturn]] void end_run(const std::string& place, const std::string& advice = "") const;

 private:
  using Handler = void (*)(int);
  Handler previous_int_, previous_term_, previous_hup_;
};

}  // namespace bielle::mechanism
