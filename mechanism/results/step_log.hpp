// A table of all attempted steps, accepted or not, next to the results: RESULTS.steps.csv.
#pragma once

#include <chrono>
#include <fstream>
#include <string>

#include "mechanism/solvers/dynamics/march.hpp"

namespace bielle::mechanism {

class StepLog {
 public:
  /// @param goes_on_from  results of the run that this one continues: their table is copied. Empty: a new table
  /// @throws ComputationError if the file cannot be written
  StepLog(const std::string& results_path, const System& system, const std::string& goes_on_from);
  /// Writes a line; lines are flushed to the operating system at least twice a second.
  void write(const Attempt& attempt);
  /// Returns the number of lines written, after flushing all of them to the operating system.
  long lines();
  /// Removes the lines after a given number: those of steps after the checkpoint, which will be written again.
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
