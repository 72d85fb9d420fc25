#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include <catch2/catch.hpp>

#include "reduce/spectral/memory_warming.hpp"

namespace {

/// What the process has of the machine's memory [MB].
double resident_MB() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmRSS:") {
      double kB = 0;
      status >> kB;
      return 1e-3 * kB;
    }
  return 0;
}

}  // namespace

TEST_CASE("Memory is touched while others work, and given back") {
  using namespace std::chrono_literals;
  const double before = resident_MB();
  double most = 0;
  {
    const bielle::MemoryWarming warming(std::size_t{200} << 20);
    for (int k = 0; k < 3000 && most < before + 200; ++k) {
      std::this_thread::sleep_for(10ms);
      most = std::max(most, resident_MB());
    }
  }
  CHECK(most > before + 200);
#ifndef __SANITIZE_ADDRESS__  // which holds back what is freed
  CHECK(resident_MB() < before + 50);
#endif
}

TEST_CASE("More memory than there is is not touched") {
  const double before = resident_MB();
  const bielle::MemoryWarming warming(std::size_t{1} << 50);
  CHECK(resident_MB() < before + 50);
}
