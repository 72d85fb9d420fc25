// Processor time, which other work on the machine does not lengthen.
#pragma once

#include <algorithm>
#include <functional>

#include <time.h>

namespace bielle::performance {

/// Returns the processor time [s] of the calling thread (CLOCK_THREAD_CPUTIME_ID), or of all threads
/// (CLOCK_PROCESS_CPUTIME_ID).
inline double processor_seconds(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Returns the time of one call by a clock [s]: the fastest of several rounds.
inline double time_of(const std::function<void()>& call, clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  call();
  double best = 1e9;
  for (int round = 0; round < 10; ++round) {
    const double start = processor_seconds(clock);
    const auto spent = [&] { return processor_seconds(clock) - start; };
    int calls = 0;
    do {
      call();
      ++calls;
    } while (spent() < 0.02);
    best = std::min(best, spent() / calls);
  }
  return best;
}

}  // namespace bielle::performance
