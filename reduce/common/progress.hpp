// Display of progress: a bar with the remaining time on a terminal, plain lines elsewhere, nothing with `quiet`.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "reduce/common/error.hpp"

namespace bielle {

/// One phase of work with its measured cost.
struct PhaseReport {
  std::string name;
  double seconds = 0;         ///< wall time
  double peak_memory_MB = 0;  ///< highest resident memory of the process so far, at the end of the phase
};

/// Reports the phases of a run on standard error and keeps their times and memory for the summary.
///
/// On a terminal a phase is one line that is redrawn (at most ten times a second); otherwise lines are printed at the
/// start of a phase, when at least five seconds have passed, and at the end. It may be called from a thread that
/// computes.
class Progress {
 public:
  /// Returns a message with the place of its subject in the input file before it.
  using Locator = std::function<std::string(const std::string& subject, const std::string& message)>;

  /// @param located  adds the place of its subject to a warning; without it warnings are shown as they are
  explicit Progress(bool quiet = false, Locator located = {});
  ~Progress();
  /// Returns a report for a part of the work. It shows no phases and no notes, and puts the part's name before
  /// warnings.
  Progress of_part(const std::string& name) const;
  void start(const std::string& phase);  ///< ends the running phase, if any
  /// Returns whether `update` would show something now.
  bool due() const;
  /// @param fraction  done of this phase, 0..1; @param detail  shown after it ("t = 0.013 s")
  void update(double fraction, const std::string& detail = "");
  void finish();  ///< ends the running phase
  /// Prints a line that stays, e.g. a warning, in spite of `quiet`.
  void warn(const std::string& message);
  /// Prints a warning about a key of the input. @param subject  key of the input, as in a `Failure`
  void warn(const std::string& subject, const std::string& message, Subject is = Subject::shown);
  void note(const std::string& message);  ///< a line that stays, unless quiet
  /// Ends the running phase and takes over the phases that another process has shown.
  void adopt(std::vector<PhaseReport> phases);
  const std::vector<PhaseReport>& phases() const { return phases_; }
  bool quiet() const { return quiet_; }

 private:
  void draw(bool end);
  void show_warning(const std::string& text);
  bool quiet_, terminal_, running_ = false;
  Locator located_;
  std::string part_;  ///< precedes warnings, unless empty
  double fraction_ = 0;
  std::string phase_, detail_;
  std::chrono::steady_clock::time_point phase_start_, last_draw_;
  std::vector<PhaseReport> phases_;
};

/// Highest resident memory of this process so far [MB].
double peak_memory_MB();

}  // namespace bielle
