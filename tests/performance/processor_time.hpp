// Processor time, which other work on the machine does not lengthen.
#pragma once

#include <time.h>

namespace bielle::performance {

/// Returns the processor time [s] of the calling thread (CLOCK_THREAD_CPUTIME_ID), or of all threads
/// (CLOCK_PROCESS_CPUTIME_ID).
inline double processor_seconds(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace bielle::performance
