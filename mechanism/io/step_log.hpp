// A table of all attempted steps, accepted or not, next to the results: RESULTS.steps.csv.
#pragma once

#include <chrono>
#include <fstream>
#include <string>

#include "mechanism/solvers/dynamics/march.hpp"

namespace bielle::mechanism {

class StepLog {
 public:
  /// @param go_on  a run goes on: the table that there is, is continued
  /// @throws ComputationError when the file cannot be written
  StepLog(const std::string& results_path, const System& system, bool go_on);
  /// A line, handed to the operating system at least twice a second.
  void write(const Attempt& attempt);

 private:
  const System& system_;
  std::string path_;
  std::ofstream file_;
  std::chrono::steady_clock::time_point flushed_;
};

}  // namespace bielle::mechanism
