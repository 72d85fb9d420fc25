// A table of all attempted steps, accepted or not, next to the results: RESULTS.steps.csv.
#pragma once

#include <chrono>
#include <fstream>
#include <string>

#include "mechanism/solvers/dynamics/march.hpp"

namespace bielle::mechanism {

class StepLog {
 public:
  /// @param goes_on_from  results of a run that this one goes on with: their table is taken over. Empty: a new one
  /// @throws ComputationError when the file cannot be written
  StepLog(const std::string& results_path, const System& system, const std::string& goes_on_from);
  /// A line, handed to the operating system at least twice a second.
  void write(const Attempt& attempt);
  /// So many have been written, and all of them are with the operating system.
  long lines();
  /// Takes out what comes after so many lines: those of steps after the point where a run goes on, which will come
  /// again.
  void go_on_after(long lines);

 private:
  void open(bool anew);
  void check() const;
  const System& system_;
  std::string path_;
  std::ofstream file_;
  long lines_ = 0;
  std::chrono::steady_clock::time_point flushed_;
};

}  // namespace bielle::mechanism
