// Functions for times and arguments of the program that compare_reduction runs.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "reduce/common/command_line.hpp"

namespace bielle::performance {

/// Returns the elapsed time.
template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Returns the shortest elapsed time of four runs.
template <class Work>
double best_seconds_of(const Work& work) {
  double best = 1e300;
  for (int k = 0; k < 4; ++k) best = std::min(best, seconds_of(work));
  return best;
}

/// Calls run(first argument, second argument, threads). @returns the status of the program
template <class Run>
int run_with_two_arguments(int argc, char** argv, const char* usage, const Run& run) {
  if (argc != 3) {
    fmt::print(stderr, "{}\n", usage);
    return 2;
  }
  try {
    run(argv[1], argv[2], available_processors());
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

}  // namespace bielle::performance
