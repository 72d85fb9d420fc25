// Interrupted runs end after the current step, or at once if they are interrupted again.
#pragma once

#include <string>

namespace bielle::mechanism {

/// During the lifetime of this object, an interrupt (Ctrl-C), a termination request or the end of the terminal lets the
/// current step finish; then the run stops. Another one, half a second later or more, ends the program at once: an
/// analysis without steps (eigen, frequency_response) takes as long as it takes.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  bool asked() const;  ///< whether the run was asked to end
  /// @param place   place of the run, for the message: "at t = 0.3 s", "before analysis 2"
  /// @param advice  instruction how to continue, for the message
  /// @throws Interrupted
  [[noreturn]] void end_run(const std::string& place, const std::string& advice = "") const;

 private:
  using Handler = void (*)(int);
  Handler previous_int_, previous_term_, previous_hup_;
};

}  // namespace bielle::mechanism
