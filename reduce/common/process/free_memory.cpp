#include "reduce/common/process/free_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include <malloc.h>
#include <sys/resource.h>

#include "reduce/common/process/address_space.hpp"

namespace bielle {

namespace {

constexpr double unknown_memory = std::numeric_limits<double>::infinity();

double left_on_machine() {
  std::ifstream file("/proc/meminfo");
  double sum = 0, kilobytes = 0;
  bool known = false;
  for (std::string key, unit; file >> key >> kilobytes; std::getline(file, unit)) {
    if (key == "MemAvailable:") known = true;
    if (key == "MemAvailable:" || key == "SwapFree:") sum += kilobytes;
  }
  return known ? sum * 1024e-6 : unknown_memory;
}

double left_below_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown_memory;
  return std::max(0.0, 1e-6 * (static_cast<double>(limit.rlim_cur) - static_cast<double>(address_space())));
}

/// Returns the memory that was freed, and that malloc keeps for the next request (library_settings.hpp).
double kept_by_malloc() {
#ifdef __GLIBC__
  return 1e-6 * static_cast<double>(mallinfo2().fordblks);
#else
  return 0;
#endif
}

}  // namespace

double free_memory_MB() { return std::min(left_on_machine(), left_below_limit()) + kept_by_malloc(); }

}  // namespace bielle
